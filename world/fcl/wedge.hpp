// SPDX-License-Identifier: BSD-3-Clause
// A wedge: a few neighbouring rays of a fan that walk one of FCL's trees together, since they meet nearly the same
// boxes.
#pragma once

#include <fcl/math/bv/AABB.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/error.hpp"
#include "world/planar/ray.hpp"

namespace waitpoint::world {

inline constexpr std::size_t rays_together = 16;

/// Rays from one origin, at most a right angle wide.
struct Wedge {
  Point origin, first, last;

  /// A lower bound of the squared distance at which one of the rays could meet the box; `no_hit` if all miss it.
  double entry(const fcl::AABBd& box) const {
    const Point half = {0.5 * (box.max_[0] - box.min_[0]), 0.5 * (box.max_[1] - box.min_[1])};
    const Point centre = {0.5 * (box.max_[0] + box.min_[0]) - origin.x, 0.5 * (box.max_[1] + box.min_[1]) - origin.y};
    const double leftmost = cross(first, centre) + (std::fabs(first.x) * half.y + std::fabs(first.y) * half.x);
    const double rightmost = cross(last, centre) - (std::fabs(last.x) * half.y + std::fabs(last.y) * half.x);
    if (leftmost < 0 || rightmost > 0) return no_hit;
    const double x = std::max(std::fabs(centre.x) - half.x, 0.0), y = std::max(std::fabs(centre.y) - half.y, 0.0);
    return x * x + y * y;
  }
};

/// The square of the greatest of a wedge's ranges.
inline double farthest_m2(std::span<const double> ranges_m) {
  const double range = *std::max_element(ranges_m.begin(), ranges_m.end());
  return range * range;
}

/// Divides a fan of directions, counter-clockwise, into wedges: calls `cast(first, count)` for each.
template <class Cast>
void for_each_wedge(std::span<const Point> directions, Cast cast) {
  for (std::size_t first = 0; first < directions.size();) {
    std::size_t count = 1;
    while (count < rays_together && first + count < directions.size() &&
           dot(directions[first], directions[first + count]) > 0) {
      ++count;
    }
    WAITPOINT_FAST_CHECK(count <= rays_together && first + count <= directions.size(), "a wedge ends beyond its fan");
    cast(first, count);
    first += count;
  }
}

}  // namespace waitpoint::world
