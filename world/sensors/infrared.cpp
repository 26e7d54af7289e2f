// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/infrared.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace waitpoint::world {

Pose infrared_mount(const InfraredRingDescription& ring, std::uint32_t finder) {
  const double heading = exact::wrap_angle(2 * exact::pi * finder / ring.count);
  const auto [s, c] = exact::sincos(heading);
  return {ring.ring_radius_m * c, ring.ring_radius_m * s, heading};
}

double infrared_v(const InfraredRingDescription& ring, double range_m, double normal) {
  WAITPOINT_CHECK(0 < ring.range_min_m && ring.range_min_m <= ring.range_max_m,
                  "an infrared ring's least range is not positive, or above its greatest");
  const double range = std::clamp(range_m, ring.range_min_m, ring.range_max_m);
  const double true_v = exact::exp(exact::log(range) / ring.exponent) / ring.gain_per_v;
  const double measured_v = true_v + ring.noise_v * normal;
  return std::max(std::nearbyint(measured_v / ring.resolution_v) * ring.resolution_v, 0.0);
}

RandomStream infrared_noise(std::uint64_t seed, std::string_view robot) {
  return RandomStream(seed, robot, "infrared.volts");
}

}  // namespace waitpoint::world
