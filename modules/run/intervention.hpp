// SPDX-License-Identifier: BSD-3-Clause
// Interventions: a person's actions on a running experiment, such as a request to a module or a move of a robot.
//
//   request ROBOT MODULE REQUEST [FIELD=VALUE ...]    fields by name: v_m_s=0.2, via.0.x=3, pose.heading=1.5
//   move ROBOT X Y [HEADING_DEG]                      placed there at rest
//   obstacle {name: ..., ...}                         a shape as in a scenario; replaces one of the same name
//   move-obstacle NAME X Y [HEADING_DEG]
//   remove-obstacle NAME
//   push NAME FX_N FY_N SECONDS                       a force on a robot or a loose obstacle; dynamic worlds only
//   seed N                                            draws from here on are those of another seed
//   tcl ROBOT COMMAND                                 evaluated by the robot's shell (modules/tcl); U+2424 is a newline
//   external ROBOT [between=stay] [KEY=VALUE ...]     from now on its body is moved by reports: see external_robot.hpp
//   report ROBOT date_s=T x_m=X y_m=Y heading_rad=A ...  of an external robot's position: see position_report.hpp
//   command ROBOT v_m_s=V w_rad_s=W ...               to its base, as by its software
//   pose ROBOT date_s=T pose.x=X pose.y=Y pose.heading=A ...  that a node has published, for its modules
//   goal ROBOT reached|given-up                       the end of its present goal, of a robot that others drive
//
// One line of text each, the same at the prompt, in a journal and in the programming interface; the digest hashes it.
// Words with spaces are in double quotes. operator.hpp describes when and how interventions are executed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/pose.hpp"
#include "core/setting.hpp"
#include "core/time.hpp"
#include "modules/posters/from_topics.hpp"
#include "modules/run/external_robot.hpp"
#include "modules/run/position_report.hpp"
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

struct SeedChange {
  std::uint64_t seed = 0;
};

struct ShellCommand {
  /// Stands for a newline in an intervention's text: SYMBOL FOR NEWLINE.
  static constexpr std::string_view newline = "\xE2\x90\xA4";

  std::string robot;
  std::string command;
};

struct ExternalDeclaration {
  std::string robot;
  ExternalSettings settings;
};

struct ExternalReport {
  std::string robot;
  PositionReport report;  ///< its time is its date
};

struct DriveCommand {
  std::string robot;
  world::Velocity velocity;
};

struct PublishedPose {
  std::string robot;
  posters::PoseOfTopic pose;
};

struct GoalEnd {
  std::string robot;
  bool is_reached = false;
};

struct Intervention {
  std::string text;
  scenario::Location written;
  std::variant<ModuleRequest, RobotMove, ObstacleMove, ObstaclePut, ObstacleRemoval, Push, SeedChange, ShellCommand,
               ExternalDeclaration, ExternalReport, DriveCommand, PublishedPose, GoalEnd>
      what;
};

/// True for interventions that come from outside many times a second: the result is told only if it is more than
/// "done".
bool is_frequent(const Intervention& intervention);

/// The first words of all kinds of interventions: "request", "move", ...
std::vector<std::string_view> intervention_verbs();

/// Parses one line. Throws BadInput at `written` for a malformed one. Names of robots, modules and requests are checked
/// by Operator::add().
Intervention parse_intervention(std::string_view text, const scenario::Location& written);

}  // namespace waitpoint::run
