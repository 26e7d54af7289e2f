// SPDX-License-Identifier: BSD-3-Clause
// Settings of the paper's modules that follow from the robot: of `ndd` the robot's outline, of `sick` the place of its
// laser. Modules do not see the world, so they get these as settings that nobody writes.
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "modules/genom/settings.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::bridge {

/// The outline of a robot's shape, in its own frame: a disc about the origin, or a convex polygon.
struct RobotOutline {
  double radius_m = 0;         ///< of the smallest disc about the origin that holds it
  std::vector<Point> corners;  ///< counter-clockwise; none: it is that disc
};
RobotOutline robot_outline(const world::Shape& shape);

/// Derives the outline's settings, whose keys begin with `prefix`. A setting that contradicts it is BadInput.
void derive_outline(const RobotOutline& outline, genom::Settings& settings, const std::string& prefix = "");

/// The module's settings as written; of the base of a robot that follows a trajectory, with the poster of its speeds.
std::vector<Setting> settings_of(const scenario::RobotScenario& robot, const scenario::ModuleScenario& module);

/// Derives what the module's type asks for. The laser of a module is that which the bridge's table connects to its
/// poster `reading`.
void derive_settings(const scenario::RobotScenario& robot, const scenario::ModuleScenario& module,
                     genom::Settings& settings);

}  // namespace waitpoint::bridge
