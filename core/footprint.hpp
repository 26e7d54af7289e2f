// SPDX-License-Identifier: BSD-3-Clause
// The outline of a robot in its own frame: a disc about the origin, or a convex polygon that contains the origin.
#pragma once

#include <span>
#include <vector>

#include "core/pose.hpp"

namespace waitpoint {

class Footprint {
 public:
  /// A disc.
  explicit Footprint(double radius_m) : radius_m_(radius_m), inner_radius_m_(radius_m) {}
  /// A polygon by its corners, counter-clockwise; without corners, or if the origin is not inside, the disc.
  Footprint(std::span<const Point> corners, double radius_m);

  bool is_disc() const { return sides_.empty(); }
  /// Of the smallest disc about the origin that holds it, and of the greatest that it holds.
  double radius_m() const { return radius_m_; }
  double inner_radius_m() const { return inner_radius_m_; }
  /// From the origin to the hull in the direction of `p`, which is not the origin.
  double reach_m(Point p) const;
  /// From the hull to a point; 0 inside.
  double distance_m(Point p) const;
  /// Points of the hull at most `spacing_m` apart, each corner among them; of a disc none.
  std::vector<Point> hull_points(double spacing_m) const;

 private:
  struct Side {
    Point start, along;   ///< along: a unit vector
    double length_m = 0;  ///< of the side
    double beyond_m = 0;  ///< the distance of the side's line from the origin
    Point outward() const { return {along.y, -along.x}; }
  };

  double radius_m_, inner_radius_m_;
  std::vector<Side> sides_;
};

}  // namespace waitpoint
