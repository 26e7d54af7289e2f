// SPDX-License-Identifier: BSD-3-Clause
#include "world/vehicles/odometer.hpp"

#include <cmath>

namespace waitpoint::world {

void UnitCounter::add(double units) {
  rest += units;
  const double whole = std::nearbyint(rest);
  rest -= whole;
  total += static_cast<std::int64_t>(whole);
}

Odometer::Odometer(const BaseDescription& base, std::uint64_t seed, std::string_view robot)
    : errors_(base.odometry), noise_(seed, robot, "odometry") {}

void Odometer::add(std::uint64_t step, double step_s, const Arc& moved) {
  if (!moved.moves()) {
    reading_.velocity = {};
    return;
  }
  const OdometryErrors& e = errors_;
  const double d = std::fabs(moved.distance_m), a = std::fabs(moved.turn_rad);
  const auto [travel_noise, turn_noise] = noise_.normal_pair(step);
  const double travel_m = e.travel_scale * moved.distance_m + e.travel_noise_m_per_sqrt_m * std::sqrt(d) * travel_noise;
  const double turn_variance = e.turn_noise_rad_per_sqrt_m * e.turn_noise_rad_per_sqrt_m * d +
                               e.turn_noise_rad_per_sqrt_rad * e.turn_noise_rad_per_sqrt_rad * a;
  const double turned_rad =
      e.turn_scale * moved.turn_rad + e.drift_rad_per_m * moved.distance_m + std::sqrt(turn_variance) * turn_noise;
  double side_m = 0;
  if (moved.side_m != 0) {
    const double side_noise = noise_.normal(step, 1);
    side_m =
        e.travel_scale * moved.side_m + e.travel_noise_m_per_sqrt_m * std::sqrt(std::fabs(moved.side_m)) * side_noise;
  }
  travel_.add(travel_m * e.units_per_m);
  turn_.add(turned_rad * e.units_per_rad);
  side_.add(side_m * e.units_per_m);
  reading_ = {travel_.total, turn_.total, {travel_m / step_s, turned_rad / step_s, side_m / step_s}, side_.total};
}

}  // namespace waitpoint::world
