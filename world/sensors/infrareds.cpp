// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/infrareds.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace waitpoint::world {

Pose infrared_mount(const Infrareds::Description& ring, std::uint32_t finder) {
  const double heading = exact::wrap_angle(2 * exact::pi * finder / ring.count);
  const auto [s, c] = exact::sincos(heading);
  return {ring.ring_radius_m * c, ring.ring_radius_m * s, heading};
}

double infrared_v(const Infrareds::Description& ring, double range_m, double normal) {
  WAITPOINT_CHECK(0 < ring.range_min_m && ring.range_min_m <= ring.range_max_m,
                  "an infrared ring's least range is not positive, or above its greatest");
  const double range = std::clamp(range_m, ring.range_min_m, ring.range_max_m);
  const double true_v = exact::exp(exact::log(range) / ring.exponent) / ring.gain_per_v;
  const double measured_v = true_v + ring.noise_v * normal;
  return std::max(std::nearbyint(measured_v / ring.resolution_v) * ring.resolution_v, 0.0);
}

Infrareds::Model::Model(const Description& description, std::uint64_t seed, std::string_view robot)
    : description_(description), noise_(seed, robot, "infrared.volts") {}

void Infrareds::Model::reseed(std::uint64_t seed, std::string_view robot) {
  noise_ = RandomStream(seed, robot, "infrared.volts");
}

void Infrareds::Model::read(const Surroundings& surroundings, std::uint64_t number, Reading& reading) const {
  const BodyState& body = surroundings.body();
  reading.volts.resize(description_.count);
  for (std::uint32_t i = 0; i < description_.count; ++i) {
    const Pose finder = compose(body.pose, infrared_mount(description_, i));
    const Beam beam{finder.position(), finder.heading, description_.height_m + body.height_m};
    const double range_m = surroundings.cast(beam, description_.range_max_m);
    reading.volts[i] = infrared_v(description_, range_m, noise_.normal(number, i));
  }
}

}  // namespace waitpoint::world
