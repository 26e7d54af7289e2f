// SPDX-License-Identifier: BSD-3-Clause
// What a beam hits, found the slow way: every shape is asked, with intersections of its own (in long double, edge by
// edge), so that an error in the world's geometry cannot hide in both.
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

  /// The distance to the nearest shape that has the height; range_max_m if none is nearer.
  long double range(const Line& line, double height_m, double range_max_m) const;

  /// Whether a shift of the beam to the side by `by_m` either way changes its range by more than `jump_m`: whether the
  /// beam only just hits or misses something.
  bool grazes(const Line& line, double height_m, double range_max_m, double by_m, double jump_m) const;

 private:
  struct Item {
    Shape shape;
    std::vector<long double> x, y;  // the corners of what has any, counter-clockwise
  };
  std::vector<Item> items_;
};

}  // namespace waitpoint::world::brute_force
