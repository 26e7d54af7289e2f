// SPDX-License-Identifier: BSD-3-Clause
// The topics of a run with nodes: the clock, the frames, the map that robots know (also as the service /static_map),
// and those of each robot.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "modules/messages/rosgraph_msgs.hpp"
#include "modules/nodes/node_side.hpp"
#include "modules/nodes/robot_topics.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::nodes {

/// Their indices.
std::vector<std::size_t> robots_with_nodes(const scenario::Scenario& scenario);

/// The scenario has robots with nodes.
NodeSideSetup node_side_setup(const scenario::Scenario& scenario);

class WorldTopics {
 public:
  /// Advertises and subscribes, before the nodes start. The scenario must outlive this.
  WorldTopics(const scenario::Scenario& scenario, const OccupancyGrid& map, std::unique_ptr<NodeSide> nodes);

  NodeSide& nodes() { return *nodes_; }
  const NodeSide& nodes() const { return *nodes_; }
  /// That of number `i` among the robots with nodes.
  RobotTopics& robot(std::size_t i) { return *robots_[i]; }

  /// After a step of the world.
  void publish(const world::World& world, Time now);
  /// Hands the nodes' messages to the robots, and those of shown topics to `shown`, which may be null. Returns a line
  /// for each message that is damaged, which is left out.
  std::vector<std::string> take_in(ShownTopics* shown);

 private:
  std::unique_ptr<NodeSide> nodes_;
  Time begin_;
  std::optional<TypedTopic<messages::rosgraph_msgs::Clock>> clock_;
  std::optional<TypedTopic<messages::tf2_msgs::TFMessage>> tf_;
  std::vector<std::unique_ptr<RobotTopics>> robots_;
};

}  // namespace waitpoint::nodes
