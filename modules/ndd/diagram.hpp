// SPDX-License-Identifier: BSD-3-Clause
// The nearness diagram: the nearest obstacle point in each of 180 sectors of 2 degrees around the robot's centre.
//
//            90 (ahead)          bisector of sector i: -180 + 2 i degrees, counter-clockwise;
//       135      |      45       indices wrap: sector 180 is sector 0.
//         \      |      /
//   (left) ------+------ (right)
//
// Minguez and Montano, "Nearness Diagram Navigation", IEEE T-RA 20(1), 2004.
#pragma once

#include <array>
#include <limits>
#include <span>

#include "core/pose.hpp"

namespace waitpoint::ndd {

inline constexpr int sector_count = 180;
inline constexpr double sector_width_rad = 2 * exact::pi / sector_count;

struct Sector {
  static constexpr double none = std::numeric_limits<double>::infinity();

  double distance_m = none;  ///< from the robot's centre to the nearest point
  double angle_rad = 0;      ///< of that point
  Point nearest;

  bool occupied() const { return distance_m < none; }
};

class Diagram {
 public:
  /// Replaces the content by `points`, in the robot's frame; points at `range_m` or farther are ignored.
  void build(std::span<const Point> points, double range_m);

  /// Any integer is an index: sectors wrap.
  const Sector& operator[](int sector) const { return sectors_[wrap(sector)]; }

  /// The sector that contains an angle in radians.
  static int sector_at(double angle_rad);
  static double bisector_rad(int sector);
  static constexpr std::size_t wrap(int sector) {
    return static_cast<std::size_t>((sector % sector_count + sector_count) % sector_count);
  }

 private:
  std::array<Sector, sector_count> sectors_;
};

}  // namespace waitpoint::ndd
