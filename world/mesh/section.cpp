// SPDX-License-Identifier: BSD-3-Clause
#include "world/mesh/section.hpp"

#include <array>
#include <cstddef>

#include "core/error.hpp"

namespace waitpoint::world {
namespace {

Point from_above(const SpaceVector& v) { return {v.x, v.y}; }

// The intersection of the height with the side between a corner below it and one not below it. Always computed from the
// lower corner, so that two triangles that share a side get the same bits.
Point passing(const SpaceVector& below, const SpaceVector& above, double height_m) {
  const double part = (height_m - below.z) / (above.z - below.z);
  WAITPOINT_FAST_CHECK(0 <= part && part <= 1, "a side is cut beyond its ends");
  return {below.x + part * (above.x - below.x), below.y + part * (above.y - below.y)};
}

/// A convex polygon in space: a triangle clipped from below and from above, with at most five corners.
struct Polygon {
  std::array<SpaceVector, 5> corners;
  std::size_t count = 0;

  void add(const SpaceVector& corner) {
    WAITPOINT_CHECK(count < corners.size(), "a triangle clipped twice has more than five corners");
    corners[count++] = corner;
  }
};

// The part above the height (`sign` 1), or below it (-1).
Polygon on_one_side(const Polygon& polygon, double height_m, double sign) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const SpaceVector &p = polygon.corners[i], &q = polygon.corners[(i + 1) % polygon.count];
    const double p_over = sign * (p.z - height_m), q_over = sign * (q.z - height_m);
    if (p_over >= 0) kept.add(p);
    if ((p_over > 0 && q_over < 0) || (p_over < 0 && q_over > 0)) {
      const Point at = p.z < q.z ? passing(p, q, height_m) : passing(q, p, height_m);
      kept.add({at.x, at.y, height_m});
    }
  }
  return kept;
}

}  // namespace

std::optional<Outline> cut(const Triangle& triangle, double height_m) {
  std::array<Point, 2> ends;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const SpaceVector &p = triangle.corners[i], &q = triangle.corners[(i + 1) % 3];
    const bool p_below = p.z < height_m, q_below = q.z < height_m;
    if (p_below != q_below) ends[count++] = p_below ? passing(p, q, height_m) : passing(q, p, height_m);
  }
  WAITPOINT_FAST_CHECK(count == 0 || count == 2, "a triangle is cut in a single point");
  if (count == 0 || ends[0] == ends[1]) return std::nullopt;
  return segment_outline(ends[0], ends[1]);
}

void cover(const Triangle& triangle, double z_low_m, double z_high_m, std::vector<Outline>& pieces) {
  if (!(triangle.low_m() < z_high_m && z_low_m < triangle.high_m())) return;
  Polygon polygon = {{triangle.corners[0], triangle.corners[1], triangle.corners[2]}, 3};
  polygon = on_one_side(on_one_side(polygon, z_low_m, 1), z_high_m, -1);
  for (std::size_t i = 2; i < polygon.count; ++i)
    pieces.push_back(triangle_outline(from_above(polygon.corners[0]), from_above(polygon.corners[i - 1]),
                                      from_above(polygon.corners[i])));
}

}  // namespace waitpoint::world
