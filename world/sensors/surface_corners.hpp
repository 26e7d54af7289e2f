// SPDX-License-Identifier: BSD-3-Clause
// What sonars hear of a cut surface beside its walls: where its segments end, and where they meet.
//
// About such a point the directions in which segments go off divide the plane into sectors. A sector wider than a half
// turn is what is before a convex edge (all of the plane, where a single segment ends); one of nearly a right angle,
// between segments that each go on, is what is before a concave corner. Neighbouring sectors have edges and corners of
// their own: a wall thinner than nothing has an edge on one side and a corner on the other.
#pragma once

#include <span>
#include <vector>

#include "world/sensors/sonar.hpp"

namespace waitpoint::world {

/// An edge, heard from the sector that goes counter-clockwise from one direction to another, wider than a half turn.
struct ConvexEdge {
  Point at, from, to;

  bool is_before(Point p) const {
    const Point d = p - at;
    return !(cross(to, d) >= 0 && cross(d, from) >= 0);
  }
};

/// Finds them. Used again and again, it allocates only for more segments than ever before.
class SurfaceCorners {
 public:
  void find(std::span<const Outline> segments);

  std::span<const ConvexEdge> edges() const { return edges_; }
  std::span<const ConcaveCorner> corners() const { return corners_; }

 private:
  struct End {
    Point at, along;  ///< unit vector from there into the segment
    double length_m, angle_rad;
    bool is_taken = false;
  };
  void add_sectors();

  std::vector<End> ends_, here_;
  std::vector<ConvexEdge> edges_;
  std::vector<ConcaveCorner> corners_;
};

}  // namespace waitpoint::world
