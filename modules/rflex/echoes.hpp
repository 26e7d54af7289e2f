// SPDX-License-Identifier: BSD-3-Clause
// Readings of a base's range finders as echoes with the devices' poses: rings of sonars and of infrared range finders,
// at equal angles around the robot's centre, the first straight ahead.
#pragma once

#include <span>

#include "modules/posters/base.hpp"

namespace waitpoint::rflex {

struct SonarRing {
  std::uint32_t count = 0;
  double radius_m = 0;

  static void fields(auto field) {
    field("count", &SonarRing::count, "number of its sonars");
    field("radius_m", &SonarRing::radius_m, "of the ring");
  }
};

/// The range of an infrared range finder is (gain_per_v V)^exponent, in metres.
struct InfraredCalibration {
  double gain_per_v = 3.7, exponent = -1;
  double range_max_m = 0.8;
  double ring_radius_m = 0.25;

  static void fields(auto field) {
    using I = InfraredCalibration;
    field("gain_per_v", &I::gain_per_v, "range in metres is (gain_per_v * volts) ^ exponent");
    field("exponent", &I::exponent, "see gain_per_v");
    field("range_max_m", &I::range_max_m, "greater ranges are no echoes");
    field("ring_radius_m", &I::ring_radius_m, "distance of the range finders from the robot's centre");
  }
};

/// Echoes of sonars, ring by ring; readings beyond the rings' count are ignored.
posters::Sonars sonar_echoes(const posters::BaseReading& report, std::span<const SonarRing> rings);
posters::Infrareds infrared_echoes(const world::Infrareds::Reading& reading, const InfraredCalibration& calibration);

}  // namespace waitpoint::rflex
