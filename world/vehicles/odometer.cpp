// SPDX-License-Identifier: BSD-3-Clause
#include "world/vehicles/odometer.hpp"

#include <cmath>

namespace waitpoint::world {
namespace {

// A bound of the slips in one step, far above a plausible number.
constexpr std::uint64_t slips_max = 1000;

bool wheels_err(const OdometryErrors& e) {
  return e.wheel_diameter_ratio != 1 || e.wheel_base_ratio != 1 || e.wheel_noise_m_per_sqrt_m != 0 ||
         e.wheel_ticks_per_m != 0;
}

bool walks_at_random(const OdometryErrors& e) {
  return e.travel_noise_m_per_sqrt_m != 0 || e.turn_noise_rad_per_sqrt_m != 0 || e.turn_noise_rad_per_sqrt_rad != 0;
}

}  // namespace

std::int64_t UnitCounter::add(double units) {
  rest += units;
  const double whole = std::nearbyint(rest);
  rest -= whole;
  total += static_cast<std::int64_t>(whole);
  return static_cast<std::int64_t>(whole);
}

Odometer::Draws::Draws(std::uint64_t seed, std::string_view robot)
    : noise(seed, robot, "odometry"), wheel_noise(seed, robot, "odometry.wheels"), slip(seed, robot, "odometry.slip") {}

Odometer::Odometer(const BaseDescription& base, std::uint64_t seed, std::string_view robot)
    : errors_(base.odometry),
      axle_m_(base.axle_m),
      wheels_err_(wheels_err(base.odometry)),
      random_(walks_at_random(base.odometry)),
      draws_(seed, robot) {}

void Odometer::add(std::uint64_t step, double step_s, const Arc& moved) {
  if (!moved.moves()) {
    reading_.velocity = {};
    return;
  }
  const OdometryErrors& e = errors_;
  Motion counted = {moved.distance_m, moved.turn_rad};
  if (wheels_err_) counted = of_wheels(step, counted);
  const double d = std::fabs(counted.travel_m), a = std::fabs(counted.turn_rad);
  const auto [travel_noise, turn_noise] = random_ ? draws_.noise.normal_pair(step) : std::array<double, 2>{};
  double travel_m = e.travel_scale * counted.travel_m + e.travel_noise_m_per_sqrt_m * std::sqrt(d) * travel_noise;
  const double turn_variance = e.turn_noise_rad_per_sqrt_m * e.turn_noise_rad_per_sqrt_m * d +
                               e.turn_noise_rad_per_sqrt_rad * e.turn_noise_rad_per_sqrt_rad * a;
  double turned_rad =
      e.turn_scale * counted.turn_rad + e.drift_rad_per_m * counted.travel_m + std::sqrt(turn_variance) * turn_noise;
  if (e.slips_per_m > 0) {
    const Motion slip = slipped(step, moved.distance_m);
    travel_m += slip.travel_m;
    turned_rad += slip.turn_rad;
  }
  double side_m = 0;
  if (moved.side_m != 0) {
    const double side_noise = draws_.noise.normal(step, 1);
    side_m =
        e.travel_scale * moved.side_m + e.travel_noise_m_per_sqrt_m * std::sqrt(std::fabs(moved.side_m)) * side_noise;
  }
  travel_.add(travel_m * e.units_per_m);
  turn_.add(turned_rad * e.units_per_rad);
  side_.add(side_m * e.units_per_m);
  reading_ = {travel_.total, turn_.total, {travel_m / step_s, turned_rad / step_s, side_m / step_s}, side_.total};
}

Odometer::Motion Odometer::of_wheels(std::uint64_t step, Motion moved) {
  const OdometryErrors& e = errors_;
  const double across = 0.5 * axle_m_ * moved.turn_rad;
  const double wheels[] = {moved.travel_m - across, moved.travel_m + across};
  const double scales[] = {0.5 * (e.wheel_diameter_ratio + 1),
                           0.5 * (e.wheel_diameter_ratio + 1) / e.wheel_diameter_ratio};
  const std::array<double, 2> noise = draws_.wheel_noise.normal_pair(step);
  double measured[2];
  for (std::size_t i = 0; i < 2; ++i) {
    measured[i] = scales[i] * wheels[i] + e.wheel_noise_m_per_sqrt_m * std::sqrt(std::fabs(wheels[i])) * noise[i];
    if (e.wheel_ticks_per_m > 0)
      measured[i] = static_cast<double>(ticks_[i].add(measured[i] * e.wheel_ticks_per_m)) / e.wheel_ticks_per_m;
  }
  return {0.5 * (measured[1] + measured[0]), e.wheel_base_ratio * (measured[1] - measured[0]) / axle_m_};
}

// The excess motion counted by spinning wheels in a step of that distance. The number of slips is drawn by inversion.
Odometer::Motion Odometer::slipped(std::uint64_t step, double distance_m) const {
  const double expected = errors_.slips_per_m * std::fabs(distance_m);
  double remaining = draws_.slip.uniform(step), probability = exact::exp(-expected);
  Motion slip = {0, 0};
  for (std::uint64_t k = 1; remaining >= probability && k <= slips_max; ++k) {
    remaining -= probability;
    probability *= expected / static_cast<double>(k);
    const double longer_m = -errors_.slip_m * exact::log(1 - draws_.slip.uniform(step, 2 * k));
    slip.travel_m += distance_m < 0 ? -longer_m : longer_m;
    slip.turn_rad += errors_.slip_turn_rad * draws_.slip.normal(step, 2 * k + 1);
  }
  return slip;
}

}  // namespace waitpoint::world
