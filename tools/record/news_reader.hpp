// SPDX-License-Identifier: BSD-3-Clause
// Reads what a recording takes from a run: the world and the posters of the robots in this process. Reading is not an
// event: a run is the same with and without it.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "modules/run/experiment.hpp"
#include "tools/record/robot_posters.hpp"
#include "tools/record/step_news.hpp"

namespace waitpoint::tools {

class NewsReader {
 public:
  enum class Obstacles : std::uint8_t { read, left_out };

  /// The scenario, which is the experiment's, and the experiment must outlive this, this the robots' tasks. The first
  /// news are all values as they are.
  NewsReader(const scenario::Scenario& scenario, run::Experiment& experiment, Obstacles obstacles);

  /// After a step of the world, at `now`.
  StepNews take(Time now);
  /// Since the last step.
  std::vector<RobotLines> lines();

 private:
  struct OfRobot {
    std::uint32_t number;
    RobotPosters posters;
    ModuleLog modules;
  };

  bool is_sample(Time now);
  bool has_new_obstacles();

  run::Experiment& experiment_;
  Obstacles obstacles_;
  std::deque<OfRobot> robots_;  // in this process
  std::optional<Time> last_sample_;
  std::optional<std::vector<world::Shape>> meshes_;  // as shown on a plan, computed once
  std::optional<std::vector<world::Shape>> drawn_;   // the obstacles as last taken
};

}  // namespace waitpoint::tools
