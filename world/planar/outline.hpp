// SPDX-License-Identifier: BSD-3-Clause
// The horizontal section of an upright shape: an oriented box, a convex polygon or a disc. And the sections and
// projections of meshes: triangles, and segments, which are boxes of width 0.
//
// Each is a core with a radius around it: a disc's core is its centre; every other outline is its own core, with radius
// 0. So the distance of two outlines is that of their cores less the radii, and a motion is that of the core's points.
//
//        apex            a triangle in its own frame: it spans the frame's box, with its longest side at the bottom and
//       .  |  .          its apex at the top, at x = apex_m
//     .    |     .
//   ---------------
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "core/pose.hpp"
#include "world/description.hpp"

namespace waitpoint::world {

struct Outline {
  Point centre;
  double axis_cos = 1, axis_sin = 0;           ///< direction of the box's own x axis
  double half_length_m = 0, half_width_m = 0;  ///< of the core's bounding box in its own frame; both 0 for a disc
  double radius_m = 0;                         ///< around the core; 0 but for a disc
  bool is_box = false;
  bool is_triangle = false;
  double apex_m = 0;                       ///< of a triangle: the x of the corner opposite its longest side
  const ConvexPolygon* polygon = nullptr;  ///< in the outline's frame; owned by the shape, must outlive the outline

  /// The point `p` of the plane in the outline's own frame.
  Point local(Point p) const {
    const Point d = p - centre;
    return {axis_cos * d.x + axis_sin * d.y, axis_cos * d.y - axis_sin * d.x};
  }
  /// A vector of the outline's own frame, in the plane.
  Point outward(Point v) const { return {axis_cos * v.x - axis_sin * v.y, axis_sin * v.x + axis_cos * v.y}; }
};

/// The polygons that outlines of these shapes point to: for owners of outlines that outlive the shapes.
std::vector<std::shared_ptr<const ConvexPolygon>> polygons_of(std::span<const Shape> shapes);

/// The section of a shape given in the world frame.
Outline outline_of(const Shape& shape);
/// The section of a shape that is fixed to a body, with the body at `body`.
Outline outline_of(const Shape& shape, const Pose& body);

/// The segment between two points.
Outline segment_outline(Point a, Point b);
/// The triangle of three points; a segment if they are collinear, or two of them are within a nanometre.
Outline triangle_outline(Point a, Point b, Point c);

/// The points whose convex hull is the core: the corners, counter-clockwise, or the centre. Those of a polygon are
/// computed on access.
class CorePoints {
 public:
  /// Of `count` <= 4 points, or of the outline's polygon.
  CorePoints(const std::array<Point, 4>& points, std::size_t count) : points_(points), count_(count) {
    WAITPOINT_FAST_CHECK(0 < count && count <= points.size(), "a core has no point, or more than its array");
  }
  explicit CorePoints(const Outline& of)
      : count_(of.polygon->sides().size()), polygon_(of.polygon), centre_(of.centre), axis_{of.axis_cos, of.axis_sin} {}

  std::size_t count() const { return count_; }
  Point operator[](std::size_t i) const {
    WAITPOINT_FAST_CHECK(i < count_, "a core has no such point");
    if (polygon_ == nullptr) return points_[i];
    const Point p = polygon_->sides()[i].start;
    return centre_ + Point{axis_.x * p.x - axis_.y * p.y, axis_.y * p.x + axis_.x * p.y};
  }

  class Iterator {
   public:
    Iterator(const CorePoints& of, std::size_t at) : of_(&of), at_(at) {}
    Point operator*() const { return (*of_)[at_]; }
    Iterator& operator++() { return ++at_, *this; }
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    const CorePoints* of_;
    std::size_t at_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, count_}; }

 private:
  std::array<Point, 4> points_;
  std::size_t count_;
  const ConvexPolygon* polygon_ = nullptr;
  Point centre_, axis_;
};
CorePoints core_points(const Outline& outline);

/// An axis-parallel rectangle, closed.
struct Bounds {
  Point low, high;

  Bounds grown(double margin_m) const {
    return {{low.x - margin_m, low.y - margin_m}, {high.x + margin_m, high.y + margin_m}};
  }
  bool contains(const Bounds& b) const {
    return low.x <= b.low.x && low.y <= b.low.y && b.high.x <= high.x && b.high.y <= high.y;
  }
  bool overlaps(const Bounds& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y;
  }
};
/// The outline's bounding rectangle, up to rounding (below 1e-12 m within a kilometre of the origin).
Bounds bounds_of(const Outline& outline);

/// The shape, raised by `by_m`.
inline Shape raised(Shape shape, double by_m) {
  shape.z_low_m += by_m;
  shape.z_high_m += by_m;
  return shape;
}

/// True if the open height intervals of two shapes overlap: shapes that stand on each other do not meet.
inline bool heights_overlap(const Shape& a, const Shape& b) { return a.z_low_m < b.z_high_m && b.z_low_m < a.z_high_m; }

}  // namespace waitpoint::world
