// SPDX-License-Identifier: BSD-3-Clause
// The reference for beams: every shape is tested, with intersections of its own (in long double, edge by edge), so that
// no error can be common to it and the world's geometry.
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "world/description.hpp"

namespace waitpoint::world::brute_force {

/// A ray with direction (cos, sin) of an angle that need not be exact.
struct Line {
  long double x, y, dx, dy;
};

class Shapes {
 public:
  explicit Shapes(const std::vector<Shape>& shapes);

  /// The distance to the nearest shape at that height; range_max_m if none is nearer.
  long double range(const Line& line, double height_m, double range_max_m) const;

  /// True if moving the beam sideways by `by_m` either way changes its range by more than `jump_m`: the beam grazes an
  /// edge.
  bool grazes(const Line& line, double height_m, double range_max_m, double by_m, double jump_m) const;

 private:
  struct Item {
    Shape shape;
    std::vector<long double> x, y;  // the corners of polygons, counter-clockwise
  };
  std::vector<Item> items_;
};

}  // namespace waitpoint::world::brute_force
