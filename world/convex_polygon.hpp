// SPDX-License-Identifier: BSD-3-Clause
// A convex polygon about its own origin: what an upright prism stands on.
//
// Corners go counter-clockwise. The origin is the middle of the box along the axes that just holds them. Every side has
// a direction that rounding leaves, for none is shorter than a nanometre, and a turn at each of its ends.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/pose.hpp"

namespace waitpoint::world {

class ConvexPolygon {
 public:
  /// What asks about all sides is bounded by this.
  static constexpr std::size_t corners_max = 64;

  struct Side {
    Point start;          ///< the corner from which it goes to the next one's
    Point outward;        ///< unit vector across it
    double beyond_m = 0;  ///< dot(outward, p) of its points p; more is outside

    friend bool operator==(const Side&, const Side&) = default;
  };

  /// Of three corners at least, which are as said above.
  explicit ConvexPolygon(std::span<const Point> corners);

  std::span<const Side> sides() const { return sides_; }
  /// From the origin to the sides of the box about it.
  Point half_size() const { return half_size_; }
  /// The mean square of the distances of its points from the origin.
  double mean_square_m2() const;

  friend bool operator==(const ConvexPolygon&, const ConvexPolygon&) = default;

 private:
  std::vector<Side> sides_;
  Point half_size_;
};

struct PlacedPolygon {
  Point origin;
  std::shared_ptr<const ConvexPolygon> polygon;
};

/// The convex hull of points, within a micrometre. Where that has too many corners, sides of it are left out whose
/// neighbours, longer, enclose least more: it never becomes smaller. None for points that a strip of that width holds.
std::optional<PlacedPolygon> hull_of(std::vector<Point> points, double width_m_min);

}  // namespace waitpoint::world
