// SPDX-License-Identifier: BSD-3-Clause
// What a person does to a run while it goes on: asks a module something, moves a robot or an obstacle.
//
//   request ROBOT MODULE REQUEST [FIELD=VALUE ...]    fields by their names: v_m_s=0.2, via.0.x=3, pose.heading=1.5
//   move ROBOT X Y [HEADING_DEG]                      lifted and put down there, at rest
//   obstacle {name: ..., ...}                         as a shape of a scenario; one of that name is replaced
//   move-obstacle NAME X Y [HEADING_DEG]
//   remove-obstacle NAME
//   push NAME FX_N FY_N SECONDS                       a force on a robot or a loose obstacle; in a dynamic world
//
// One line of text each, the same at the prompt, in a journal and in the programming interface: it is also what the
// digest hashes. A word with spaces stands in double quotes. See operator.hpp for when and how it is carried out.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/pose.hpp"
#include "core/setting.hpp"
#include "core/time.hpp"
#include "modules/scenario/location.hpp"
#include "world/description.hpp"

namespace waitpoint::run {

struct ModuleRequest {
  std::string robot, module, request;
  std::vector<Setting> arguments;  ///< of the request's declared fields
};

struct RobotMove {
  std::string robot;
  Pose pose;
};

struct ObstacleMove {
  std::string name;
  Pose pose;
};

struct ObstaclePut {
  world::Obstacle obstacle;
};

struct ObstacleRemoval {
  std::string name;
};

struct Push {
  std::string name;
  Point force_n;
  Duration time;
};

struct Intervention {
  std::string text;
  scenario::Location written;
  std::variant<ModuleRequest, RobotMove, ObstacleMove, ObstaclePut, ObstacleRemoval, Push> what;
};

/// The first words of interventions: "request", "move", ...
std::vector<std::string_view> intervention_verbs();

/// Reads one line. Throws BadInput at `written` for what is no intervention; whether the run has such a robot is asked
/// when it is given to the run.
Intervention parse_intervention(std::string_view text, const scenario::Location& written);

}  // namespace waitpoint::run
