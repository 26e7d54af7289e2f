// SPDX-License-Identifier: BSD-3-Clause
#include "world/vehicles/odometer.hpp"

#include <cmath>

namespace waitpoint::world {
namespace {

void count(double units, double& rest, std::int64_t& total) {
  rest += units;
  const double whole = std::nearbyint(rest);
  rest -= whole;
  total += static_cast<std::int64_t>(whole);
}

}  // namespace

Odometer::Odometer(const OdometryErrors& errors, std::uint64_t seed, std::string_view robot)
    : errors_(errors), noise_(seed, robot, "odometry") {}

void Odometer::add(std::uint64_t step, double step_s, double distance_m, double turn_rad) {
  if (distance_m == 0 && turn_rad == 0) {
    reading_.velocity = {};
    return;
  }
  const OdometryErrors& e = errors_;
  const double d = std::fabs(distance_m), a = std::fabs(turn_rad);
  const auto [travel_noise, turn_noise] = noise_.normal_pair(step);
  const double travel_m = e.travel_scale * distance_m + e.travel_noise_m_per_sqrt_m * std::sqrt(d) * travel_noise;
  const double turn_variance = e.turn_noise_rad_per_sqrt_m * e.turn_noise_rad_per_sqrt_m * d +
                               e.turn_noise_rad_per_sqrt_rad * e.turn_noise_rad_per_sqrt_rad * a;
  const double turned_rad =
      e.turn_scale * turn_rad + e.drift_rad_per_m * distance_m + std::sqrt(turn_variance) * turn_noise;
  count(travel_m * e.units_per_m, travel_rest_, reading_.travel_units);
  count(turned_rad * e.units_per_rad, turn_rest_, reading_.turn_units);
  reading_.velocity = {travel_m / step_s, turned_rad / step_s};
}

}  // namespace waitpoint::world
