// SPDX-License-Identifier: BSD-3-Clause
#include "world/vehicles/battery.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::world {

BatteryPack::BatteryPack(const Battery::Description& description)
    : description_(description),
      drawn_ah_((1 - description.charge) * description.capacity_ah),
      current_a_(description.idle_a) {}

void BatteryPack::draw(Duration now, Duration step, const Velocity& velocity, bool stalled) {
  if (empty()) return;
  const Battery::Description& d = description_;
  current_a_ = d.idle_a + d.drive_a_per_m_s * exact::hypot(velocity.v_m_s, velocity.side_m_s) +
               d.turn_a_per_rad_s * std::fabs(velocity.w_rad_s) +
               d.climb_a_per_m_s * std::max(velocity.climb_m_s, 0.0) + (stalled ? d.stalled_a : 0);
  if (current_a_ > 0) {
    const double rate = exact::exp((d.peukert - 1) * exact::log(current_a_ * d.rated_h / d.capacity_ah));
    drawn_ah_ += current_a_ * rate * step.seconds() / 3600;
  }
  if (drawn_ah_ < d.capacity_ah && volts() >= d.off_v) return;
  empty_at_ = now;
  current_a_ = 0;
}

double BatteryPack::volts() const {
  const Battery::Description& d = description_;
  const double used = std::min(drawn_ah_ / d.capacity_ah, 1.0);
  return d.volts_full - (d.volts_full - d.volts_empty) * used - d.resistance_ohm * current_a_;
}

Battery::Reading BatteryPack::reading() const {
  const Battery::Description& d = description_;
  double told_v = volts();
  if (d.resolution_v > 0) told_v = std::nearbyint(told_v / d.resolution_v) * d.resolution_v;
  return {.volts = told_v,
          .current_a = current_a_,
          .charge = std::max(1 - drawn_ah_ / d.capacity_ah, 0.0),
          .empty = empty(),
          .empty_after = empty_at_.value_or(Duration())};
}

}  // namespace waitpoint::world
