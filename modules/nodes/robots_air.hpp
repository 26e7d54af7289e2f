// SPDX-License-Identifier: BSD-3-Clause
// The medium between the nodes of different robots, and the delay within a robot, as the layer below the nodes'
// processes models them (fibers/posix/links/air.hpp): declared here, with the robots' true places.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fibers/posix/links/air.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/world.hpp"

namespace waitpoint::nodes {

/// The number of a robot on the air, by its place among the robots with nodes.
inline int number_on_air(std::size_t robot) { return static_cast<int>(robot) + 1; }

class RobotsAir {
 public:
  /// `robots`: indices of the scenario's robots with nodes. Before any node starts. Without a medium between several
  /// robots and without a delay, messages are at once. The scenario must outlive this. BadInput for more robots than
  /// there is room for.
  RobotsAir(const scenario::Scenario& scenario, const std::vector<std::size_t>& robots);

  /// The robots have moved.
  void move(const world::World& world);
  /// The losses so far, for the summary: "" or ", 3 messages lost, 12 sent again".
  std::string losses() const;

 private:
  posix::Air* air_ = nullptr;  // null: messages are at once
  std::vector<std::size_t> robots_;
};

}  // namespace waitpoint::nodes
