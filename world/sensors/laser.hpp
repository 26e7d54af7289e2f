// SPDX-License-Identifier: BSD-3-Clause
// A SICK LMS as a model of errors on true ranges: a bias, noise that grows with the range, and whole steps of
// resolution.
//
// The data sheet gives the standard deviation to 8 m, and twice that at 20 m; between, we take it as linear, and beyond
// as constant.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/random.hpp"
#include "world/description.hpp"

namespace waitpoint::world {

/// The standard deviation of a range.
double range_noise_m(const LaserDescription& laser, double range_m);

class Laser {
 public:
  /// Draws from the stream (seed, robot, "laser <number>.range"), at tick = number of the scan, index = beam.
  Laser(const LaserDescription& description, std::uint64_t seed, std::string_view robot, std::size_t number);

  double first_angle_rad() const { return -0.5 * description_->field_of_view_rad; }
  /// Between neighbouring beams; 0 for a single one.
  double angle_step_rad() const;
  /// The unit vectors of the beams in the device's frame, counter-clockwise.
  std::span<const Point> directions() const { return directions_; }

  /// Turns true ranges into measured ones, in place. A true range at or beyond range_max_m stays without echo and reads
  /// range_max_m, as does a measured one that comes out beyond it; none is below 0.
  void measure(std::uint64_t scan_number, std::span<double> ranges_m) const;

 private:
  const LaserDescription* description_;
  RandomStream noise_;
  std::vector<Point> directions_;
};

}  // namespace waitpoint::world
