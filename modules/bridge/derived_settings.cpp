// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/derived_settings.hpp"

#include <algorithm>

#include "modules/executive/trajectory_follower.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::bridge {
namespace {

constexpr const char* of_shape = "the robot's shape";

void derive_mount(const scenario::RobotScenario& robot, const std::string& module, genom::Settings& settings) {
  const auto row = std::find_if(robot.bridge.begin(), robot.bridge.end(),
                                [&](const auto& each) { return each.poster == module + ".reading"; });
  if (row == robot.bridge.end()) return;
  const auto& names = robot.laser_names;
  const auto laser = std::find(names.begin(), names.end(), row->device.substr(0, row->device.find('.')));
  if (laser == names.end()) return;
  const Pose& mount = robot.body.sensors<world::Lasers>()[static_cast<std::size_t>(laser - names.begin())].mount;
  const std::string from = "the mount of '" + *laser + "'";
  settings.derive("mount_x_m", mount.x, from);
  settings.derive("mount_y_m", mount.y, from);
  settings.derive("mount_heading_deg", mount.heading * (180 / exact::pi), from);
}

}  // namespace

RobotOutline robot_outline(const world::Shape& shape) {
  RobotOutline outline;
  const Point centre = shape.pose.position();
  if (shape.kind == world::Shape::Kind::cylinder) {
    outline.radius_m = length(centre) + shape.radius_m;
    return outline;
  }
  for (const Point corner : core_points(outline_of(shape))) {
    outline.corners.push_back(corner);
    outline.radius_m = std::max(outline.radius_m, length(corner));
  }
  return outline;
}

void derive_outline(const RobotOutline& outline, genom::Settings& settings, const std::string& prefix) {
  settings.derive(prefix + "robot_radius_m", outline.radius_m, of_shape);
  const auto key = [&](std::size_t corner) { return prefix + "footprint." + std::to_string(corner); };
  for (std::size_t i = 0; i < outline.corners.size(); ++i) {
    settings.derive(key(i) + ".x", outline.corners[i].x, of_shape);
    settings.derive(key(i) + ".y", outline.corners[i].y, of_shape);
  }
  if (const std::string beyond = key(outline.corners.size()) + ".x"; settings.has(beyond))
    settings.reject(beyond, "left out: the robot's shape has " + std::to_string(outline.corners.size()) + " corners");
}

std::vector<Setting> settings_of(const scenario::RobotScenario& robot, const scenario::ModuleScenario& module) {
  constexpr const char* key = "speed_poster";
  std::vector<Setting> settings = module.settings;
  const bool is_set =
      std::any_of(settings.begin(), settings.end(), [&](const Setting& each) { return each.key == key; });
  if (robot.trajectory && module.type == "rflex" && !is_set)
    settings.push_back({key, executive::TrajectoryFollower::speed_poster, module.written.file, module.written.line});
  return settings;
}

void derive_settings(const scenario::RobotScenario& robot, const scenario::ModuleScenario& module,
                     genom::Settings& settings) {
  if (module.type == "ndd") derive_outline(robot_outline(robot.body.shape), settings);
  if (module.type == "sick") derive_mount(robot, module.name, settings);
}

}  // namespace waitpoint::bridge
