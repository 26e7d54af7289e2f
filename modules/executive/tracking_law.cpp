// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/tracking_law.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::executive {
namespace {

// The linearised errors y and angle are damped by k_a / (2 v sqrt(k_y)): 0.62 at a metre per second, more below.
constexpr double k_x_per_s = 1, k_y_per_m2 = 4, k_a_per_s = 2.5;
constexpr double v_correction_m_s_max = 0.3, w_correction_rad_s_max = 0.6;

}  // namespace

posters::SpeedInput tracking_speeds(const TrajectoryPoint& wanted, const Pose& pose) {
  constexpr double small_rad = 1e-6;
  const Pose error = between(pose, wanted.pose);
  const auto [sin, cos] = exact::sincos(error.heading);
  const double sinc = std::fabs(error.heading) > small_rad ? sin / error.heading : 1;
  const double v = std::clamp(k_x_per_s * error.x, -v_correction_m_s_max, v_correction_m_s_max);
  const double w = std::clamp(k_y_per_m2 * wanted.v_m_s * error.y * sinc + k_a_per_s * error.heading,
                              -w_correction_rad_s_max, w_correction_rad_s_max);
  return {.v_m_s = wanted.v_m_s * cos + v, .w_rad_s = wanted.w_rad_s + w};
}

}  // namespace waitpoint::executive
