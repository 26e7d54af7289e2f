// SPDX-License-Identifier: BSD-3-Clause
#include "modules/wander/way.hpp"

#include <algorithm>
#include <cmath>

#include "core/exact_math.hpp"

namespace waitpoint::wander {

Way::Room Way::room(const posters::LaserReading& scan) {
  if (scan.first_angle_rad != first_angle_rad_ || scan.angle_step_rad != angle_step_rad_) {
    first_angle_rad_ = scan.first_angle_rad;
    angle_step_rad_ = scan.angle_step_rad;
    first_ = exact::sincos(first_angle_rad_);
    step_ = exact::sincos(angle_step_rad_);
  }
  Room room = {scan.range_max_m, 0, 0};
  std::size_t beams_left = 0, beams_right = 0;
  const auto [first_s, first_c] = first_;
  const auto [step_s, step_c] = step_;
  Point direction = {first_c, first_s};
  for (const float range : scan.range_m) {
    const double range_m = static_cast<double>(range);
    if (direction.y > 0) room.left_m += range_m, ++beams_left;
    if (direction.y < 0) room.right_m += range_m, ++beams_right;
    const bool in_lane = direction.x > 0 && std::fabs(range_m * direction.y) < parameters_.half_width_m;
    if (in_lane && range_m < scan.range_max_m) room.ahead_m = std::min(room.ahead_m, range_m * direction.x);
    direction = {step_c * direction.x - step_s * direction.y, step_s * direction.x + step_c * direction.y};
  }
  room.left_m /= static_cast<double>(std::max<std::size_t>(beams_left, 1));
  room.right_m /= static_cast<double>(std::max<std::size_t>(beams_right, 1));
  return room;
}

void Way::decide(const posters::LaserReading& scan, bool stalled, Time now, posters::BaseCommand& command) {
  const Room there = room(scan);
  command = {};
  if (stalled && now >= back_until_) {
    // Backs off; then turns to the side with more room unless the lane is clear.
    back_until_ = now + parameters_.back_off_ms;
    turning_ = there.left_m >= there.right_m ? 1 : -1;
  }
  if (now < back_until_) {
    command.v_m_s = -0.5 * parameters_.v_m_s;
    return;
  }
  if (there.ahead_m >= parameters_.clear_m) {
    turning_ = 0;
    const double room_m = there.ahead_m - parameters_.clear_m;
    command.v_m_s = parameters_.v_m_s * (room_m < parameters_.slow_m ? 0.2 + 0.8 * room_m / parameters_.slow_m : 1);
    return;
  }
  if (turning_ == 0) turning_ = there.left_m >= there.right_m ? 1 : -1;
  command.w_rad_s = turning_ * parameters_.w_rad_s;
}

}  // namespace waitpoint::wander
