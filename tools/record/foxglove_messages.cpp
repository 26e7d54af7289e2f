// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/foxglove_messages.hpp"

#include "modules/messages/poses.hpp"

namespace waitpoint::tools {

using messages::stamp_of;

foxglove::LaserScan scan_of(const posters::LaserReading& reading, const std::string& frame) {
  const auto steps = static_cast<double>(reading.range_m.size() > 0 ? reading.range_m.size() - 1 : 0);
  foxglove::LaserScan scan;
  scan.timestamp = stamp_of(reading.date);
  scan.frame_id = frame;
  scan.pose = messages::pose_message({});
  scan.start_angle = reading.first_angle_rad;
  scan.end_angle = reading.first_angle_rad + steps * reading.angle_step_rad;
  scan.ranges.assign(reading.range_m.begin(), reading.range_m.end());
  return scan;
}

foxglove::Log line_of(Time date, const std::string& writer, const std::string& text, bool is_warning) {
  using foxglove::Log;
  return {.timestamp = stamp_of(date),
          .level = is_warning ? messages::constant<Log>("WARNING") : messages::constant<Log>("INFO"),
          .message = text,
          .name = writer,
          .file = ""};
}

foxglove::SceneUpdate scene_of(Time date, const std::string& frame, const std::vector<world::Shape>& shapes) {
  constexpr foxglove::Color grey{0.6, 0.6, 0.65, 1};
  foxglove::SceneEntity entity;
  entity.timestamp = stamp_of(date);
  entity.frame_id = frame;
  entity.id = "world";
  entity.frame_locked = true;
  for (const world::Shape& shape : shapes) {
    const double height_m = shape.z_high_m - shape.z_low_m;
    const messages::geometry_msgs::Pose pose = messages::pose_message(shape.pose, (shape.z_low_m + shape.z_high_m) / 2);
    if (shape.kind == world::Shape::Kind::cylinder)
      entity.cylinders.push_back({pose, {2 * shape.radius_m, 2 * shape.radius_m, height_m}, 1, 1, grey});
    else
      entity.cubes.push_back({pose, {shape.length_m, shape.width_m, height_m}, grey});
  }
  return {{entity}};
}

foxglove::PosesInFrame poses_of(const nodes::ShownMessage& message, const std::string& frame) {
  foxglove::PosesInFrame poses{stamp_of(message.date), frame, {}};
  for (const Pose& pose : message.poses) poses.poses.push_back(messages::pose_message(pose));
  return poses;
}

}  // namespace waitpoint::tools
