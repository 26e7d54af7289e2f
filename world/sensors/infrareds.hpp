// SPDX-License-Identifier: BSD-3-Clause
// Infrared range finders: triangulation gives a voltage that falls with the range, V = r^(1/e) / g, with noise, and
// quantised by a converter. The standard deviation of a range is |e| r / V times that of V: small near, large far away.
//
// Without an echo the voltage is that of the greatest range; below the least range it is that of the least.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/random.hpp"
#include "world/sensors/surroundings.hpp"
#include "world/sensors/types/infrareds.hpp"

namespace waitpoint::world {

/// The pose of a range finder in the body's frame.
Pose infrared_mount(const Infrareds::Description& ring, std::uint32_t finder);

/// The voltage for a true range, given a standard normal draw; never below 0.
double infrared_v(const Infrareds::Description& ring, double range_m, double normal);

class Infrareds::Model {
 public:
  /// Draws from the stream (seed, robot, "infrared.volts"), at tick = number of the reading, index = range finder.
  Model(const Description& description, std::uint64_t seed, std::string_view robot);

  void reseed(std::uint64_t seed, std::string_view robot);
  void read(const Surroundings& surroundings, std::uint64_t number, Reading& reading) const;

 private:
  Description description_;
  RandomStream noise_;
};

}  // namespace waitpoint::world
