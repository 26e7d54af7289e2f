// SPDX-License-Identifier: BSD-3-Clause
// Parts of messages from values of the plane, and back.
#pragma once

#include <array>
#include <string>

#include "core/exact_math.hpp"
#include "core/pose.hpp"
#include "modules/messages/geometry_msgs.hpp"
#include "modules/messages/std_msgs.hpp"

namespace waitpoint::messages {

inline std_msgs::Header header_of(Time date, const std::string& frame) { return {0, stamp_of(date), frame}; }

/// Turned about z.
inline geometry_msgs::Quaternion quaternion_of(double heading_rad) {
  const auto [s, c] = exact::sincos(heading_rad / 2);
  return {0, 0, s, c};
}
inline geometry_msgs::Pose pose_message(const Pose& pose, double z_m = 0) {
  return {{pose.x, pose.y, z_m}, quaternion_of(pose.heading)};
}

/// The heading of a rotation in space: that of its x axis in the plane. The quaternion need not have the length 1.
inline double heading_of(const geometry_msgs::Quaternion& q) {
  if (q.x == 0 && q.y == 0) return exact::wrap_angle(2 * exact::atan2(q.z, q.w));  // as quaternion_of() has it
  return exact::atan2(2 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z);
}
inline Pose pose_of(const geometry_msgs::Pose& message) {
  return {message.position.x, message.position.y, heading_of(message.orientation)};
}

/// Of x, y and heading in row order, as ROS has it: of x, y, z and the angles about them.
using PlaneCovariance = std::array<double, 9>;
inline constexpr std::size_t plane_rows[] = {0, 1, 5}, space_rows = 6;

inline std::array<double, 36> space_covariance(const PlaneCovariance& plane) {
  std::array<double, 36> space{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      space[space_rows * plane_rows[row] + plane_rows[column]] = plane[3 * row + column];
  return space;
}
inline PlaneCovariance plane_covariance(const std::array<double, 36>& space) {
  PlaneCovariance plane{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      plane[3 * row + column] = space[space_rows * plane_rows[row] + plane_rows[column]];
  return plane;
}

}  // namespace waitpoint::messages
