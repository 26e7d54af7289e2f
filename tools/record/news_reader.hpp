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

/// Which steps are samples: the first one, and each that is a tenth of a second or more after the last sample.
class Sampling {
 public:
  /// To be asked at every step.
  bool is_due(Time now);

 private:
  std::optional<Time> last_;
};

class NewsReader {
 public:
  enum class Obstacles : std::uint8_t { read, left_out };
  enum class Lines : std::uint8_t { read, left_out };

  /// The scenario, which is the experiment's, and the experiment must outlive this, this the robots' tasks if it reads
  /// the lines of their modules. The first news are all that there is.
  NewsReader(const scenario::Scenario& scenario, run::Experiment& experiment, Obstacles obstacles,
             Lines lines = Lines::read);

  /// After a step of the world, at `now`.
  StepNews take(Time now) { return take(now, sampling_.is_due(now)); }
  /// The same, where the caller knows if the step is a sample.
  StepNews take(Time now, bool is_sampled);
  /// Since the last step.
  std::vector<RobotLines> lines();

 private:
  struct OfRobot {
    std::uint32_t number;
    RobotPosters posters;
    ModuleLog modules;
  };

  bool has_new_obstacles();

  run::Experiment& experiment_;
  Obstacles obstacles_;
  std::deque<OfRobot> robots_;  // in this process
  Sampling sampling_;
  std::optional<std::vector<world::Shape>> meshes_;  // as shown on a plan, computed once
  std::optional<std::vector<world::Shape>> drawn_;   // the obstacles as last taken
};

}  // namespace waitpoint::tools
