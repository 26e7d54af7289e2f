// SPDX-License-Identifier: BSD-3-Clause
// Infrared range finders: triangulation gives a voltage that falls with the range, V = r^(1/e) / g, with noise, and
// quantised by a converter. The standard deviation of a range is |e| r / V times that of V: small near, large far away.
//
// Without an echo the voltage is that of the greatest range; below the least range it is that of the least.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/pose.hpp"
#include "core/random.hpp"
#include "world/sensor_description.hpp"

namespace waitpoint::world {

/// The pose of a range finder in the body's frame.
Pose infrared_mount(const InfraredRingDescription& ring, std::uint32_t finder);

/// The voltage for a true range, given a standard normal draw; never below 0.
double infrared_v(const InfraredRingDescription& ring, double range_m, double normal);

/// The stream (seed, robot, "infrared.volts") of the noise: tick = number of the reading, index = range finder.
RandomStream infrared_noise(std::uint64_t seed, std::string_view robot);

}  // namespace waitpoint::world
