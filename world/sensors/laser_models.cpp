// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/laser_models.hpp"

#include <cmath>

namespace waitpoint::world {
namespace {

constexpr double degree = exact::pi / 180;

bool about(double a, double b) { return std::fabs(a - b) < 1e-9; }

}  // namespace

LaserDescription lms_200() {
  LaserDescription laser;
  laser.range_max_m = lms_range_max_m(laser.resolution_m);
  laser.mirror_turn = Duration::from_ns(1'000'000'000 / 75);
  laser.interlaced_turns = 2;
  laser.spot_m = 0.008;
  laser.spot_divergence_rad = 0.015;
  laser.line_bit_s = 500000;
  return laser;
}

LaserDescription lms_291() {
  LaserDescription laser = lms_200();
  laser.range_noise_m = 0.01;
  laser.noise_growth = 1;
  return laser;
}

std::optional<std::string> set_lms_mode(LaserDescription& laser) {
  const double view = laser.field_of_view_rad;
  const bool narrow = about(view, 90 * degree) || about(view, 100 * degree);
  if (!narrow && !about(view, 180 * degree)) return "expected an LMS to look over 90, 100 or 180 degrees";
  for (const std::uint32_t turns : {1u, 2u, 4u}) {
    if (!about(view, (laser.beams - 1) * degree / turns) || (turns == 4 && !narrow)) continue;
    laser.interlaced_turns = turns;
    return std::nullopt;
  }
  return "expected an LMS to have a beam each degree or half a degree, or each quarter over 100 degrees";
}

double lms_range_max_m(double resolution_m) { return 8191 * resolution_m; }

}  // namespace waitpoint::world
