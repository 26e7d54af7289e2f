// SPDX-License-Identifier: BSD-3-Clause
#include "world/space_pose.hpp"

#include "core/exact_math.hpp"

namespace waitpoint::world {

SpacePose space_pose(SpaceVector position, double roll_rad, double pitch_rad, double yaw_rad) {
  const auto [sr, cr] = exact::sincos(roll_rad);
  const auto [sp, cp] = exact::sincos(pitch_rad);
  const auto [sy, cy] = exact::sincos(yaw_rad);
  SpacePose pose;
  pose.position = position;
  pose.axes[0] = {cy * cp, sy * cp, -sp};
  pose.axes[1] = {cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr};
  pose.axes[2] = {cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr};
  return pose;
}

SpacePose compose(const SpacePose& outer, const SpacePose& inner) {
  SpacePose pose;
  pose.position = outer.position + outer.turned(inner.position);
  for (std::size_t i = 0; i < 3; ++i) pose.axes[i] = outer.turned(inner.axes[i]);
  return pose;
}

}  // namespace waitpoint::world
