// SPDX-License-Identifier: BSD-3-Clause
// A convex polygon about its own origin: the base of an upright prism.
//
// Corners are counter-clockwise. The origin is the middle of their axis-parallel bounding box. Every side is at least a
// nanometre long, so that rounding leaves its direction, and turns at both ends.
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
  /// Bounds the cost of loops over all sides.
  static constexpr std::size_t corners_max = 64;

  struct Side {
    Point start;          ///< its first corner; it ends at the next side's
    Point outward;        ///< unit normal
    double beyond_m = 0;  ///< dot(outward, p) of its points p; greater values are outside

    friend bool operator==(const Side&, const Side&) = default;
  };

  /// At least three corners that meet the conditions above.
  explicit ConvexPolygon(std::span<const Point> corners);

  std::span<const Side> sides() const { return sides_; }
  /// Half the size of the bounding box.
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

/// The convex hull of points, within a micrometre. With too many corners, the sides whose omission adds the least area
/// are left out, and their neighbours extended: the hull never becomes smaller. None if the points lie in a strip
/// narrower than `width_m_min`.
std::optional<PlacedPolygon> hull_of(std::vector<Point> points, double width_m_min);

}  // namespace waitpoint::world
