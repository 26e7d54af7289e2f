// SPDX-License-Identifier: BSD-3-Clause
// The edges and corners of a cut surface, which sonars hear besides its walls: the ends and junctions of its segments.
//
// The directions of the segments at such a point divide the plane into sectors. A sector wider than a half turn is the
// space in front of a convex edge (the whole plane at the end of a single segment); a sector of nearly a right angle,
// between segments long enough, is the space in front of a concave corner. Each sector has its own edge or corner: a
// bend of a wall without thickness is an edge on one side and a corner on the other.
#pragma once

#include <span>
#include <vector>

#include "world/sensors/sonar.hpp"

namespace waitpoint::world {

/// An edge, heard in the sector counter-clockwise from direction `from` to direction `to`, wider than a half turn.
struct ConvexEdge {
  Point at, from, to;

  bool is_before(Point p) const {
    const Point d = p - at;
    return !(cross(to, d) >= 0 && cross(d, from) >= 0);
  }
};

/// Finds the edges and corners. Reused: it allocates only for more segments than ever before.
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

  std::vector<End> ends_, ends_at_corner_;
  std::vector<ConvexEdge> edges_;
  std::vector<ConcaveCorner> corners_;
};

}  // namespace waitpoint::world
