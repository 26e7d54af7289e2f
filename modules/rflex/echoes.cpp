// SPDX-License-Identifier: BSD-3-Clause
#include "modules/rflex/echoes.hpp"

#include <algorithm>

#include "core/exact_math.hpp"

namespace waitpoint::rflex {
namespace {

Pose ring_mount(std::uint32_t number, std::uint32_t count, double radius_m) {
  const double bearing = 2 * exact::pi * number / count;
  const auto [s, c] = exact::sincos(bearing);
  return {radius_m * c, radius_m * s, exact::wrap_angle(bearing)};
}

}  // namespace

posters::Sonars sonar_echoes(const posters::BaseReading& report, std::span<const SonarRing> rings) {
  posters::Sonars sonars;
  sonars.date = report.date;
  std::size_t sonar = 0;
  for (const SonarRing& ring : rings) {
    for (std::uint32_t i = 0; i < ring.count && sonar < report.sonar_m.size(); ++i)
      sonars.echoes.push_back({ring_mount(i, ring.count, ring.radius_m), report.sonar_m[sonar++]});
  }
  return sonars;
}

posters::Infrareds infrared_echoes(const world::Infrareds::Reading& reading, const InfraredCalibration& of) {
  posters::Infrareds infrareds;
  infrareds.date = reading.date;
  const std::uint32_t count = static_cast<std::uint32_t>(reading.volts.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const double volts = reading.volts[i];
    const double range_m = volts > 0 ? exact::exp(of.exponent * exact::log(of.gain_per_v * volts)) : of.range_max_m;
    infrareds.echoes.push_back({ring_mount(i, count, of.ring_radius_m), std::min(range_m, of.range_max_m)});
  }
  return infrareds;
}

}  // namespace waitpoint::rflex
