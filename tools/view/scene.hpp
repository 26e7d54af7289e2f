// SPDX-License-Identifier: BSD-3-Clause
// The constant part of a run: the floor, the robots with their sensors, modules, posters and goals, the names of
// operations. It is the head of a viewer's data.
#pragma once

#include <string>
#include <vector>

#include "modules/run/experiment.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {

struct SceneOptions {
  std::uint64_t seed = 0;
  kernel::Order order = kernel::Order::fifo;
  Time until;
  std::string program;         ///< its name and version
  bool is_controlled = false;  ///< viewers may act on the run
};

/// The obstacles as they are now, and the outlines of meshes on the plan.
std::vector<world::Obstacle> obstacles_shown(const run::Experiment& experiment);

/// The whole scene. Robots whose software is in another process have a body only.
Json scene(const scenario::Scenario& scenario, const run::Experiment& experiment, const SceneOptions& options);

}  // namespace waitpoint::tools::view
