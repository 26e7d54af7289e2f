// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/laser.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace waitpoint::world {
namespace {

double measured(const LaserDescription& laser, double true_m, double normal) {
  if (true_m >= laser.range_max_m) return laser.range_max_m;
  double range = true_m + laser.range_bias_m + range_noise_m(laser, true_m) * normal;
  if (laser.resolution_m > 0) range = std::nearbyint(range / laser.resolution_m) * laser.resolution_m;
  return std::clamp(range, 0.0, laser.range_max_m);
}

}  // namespace

double range_noise_m(const LaserDescription& laser, double range_m) {
  constexpr double constant_to_m = 8, double_from_m = 20;
  const double growth = (range_m - constant_to_m) / (double_from_m - constant_to_m);
  return laser.range_noise_m * (1 + std::clamp(growth, 0.0, 1.0));
}

Laser::Laser(const LaserDescription& description, std::uint64_t seed, std::string_view robot, std::size_t number)
    : description_(&description), noise_(seed, robot, "laser " + std::to_string(number) + ".range") {
  for (std::uint32_t i = 0; i < description.beams; ++i) {
    const auto [s, c] = exact::sincos(first_angle_rad() + i * angle_step_rad());
    directions_.push_back({c, s});
  }
}

double Laser::angle_step_rad() const {
  return description_->beams > 1 ? description_->field_of_view_rad / (description_->beams - 1) : 0;
}

void Laser::measure(std::uint64_t scan_number, std::span<double> ranges_m) const {
  const bool noisy = description_->range_noise_m > 0;
  for (std::size_t i = 0; i < ranges_m.size(); i += 2) {
    std::array<double, 2> normals{};
    if (noisy) normals = noise_.normal_pair(scan_number, i / 2);
    ranges_m[i] = measured(*description_, ranges_m[i], normals[0]);
    if (i + 1 < ranges_m.size()) ranges_m[i + 1] = measured(*description_, ranges_m[i + 1], normals[1]);
  }
}

}  // namespace waitpoint::world
