// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/surface_corners.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/error.hpp"

namespace waitpoint::world {
namespace {

// Ends within this distance coincide.
constexpr double coinciding_m = 1e-6;
// The least turn at an edge: joints within a wall of several triangles turn less, by rounding.
constexpr double turn_rad_min = 1e-3;

}  // namespace

void SurfaceCorners::find(std::span<const Outline> segments) {
  ends_.clear();
  edges_.clear();
  corners_.clear();
  for (const Outline& segment : segments) {
    if (segment.half_length_m <= coinciding_m) continue;
    const double length_m = 2 * segment.half_length_m;
    const Point along = segment.outward({1, 0}), back = {-along.x, -along.y};
    const Point half = segment.half_length_m * along;
    ends_.push_back({segment.centre - half, along, length_m, exact::atan2(along.y, along.x)});
    ends_.push_back({segment.centre + half, back, length_m, exact::atan2(back.y, back.x)});
  }
  std::sort(ends_.begin(), ends_.end(), [](const End& a, const End& b) {
    return std::tie(a.at.x, a.at.y, a.angle_rad, a.length_m) < std::tie(b.at.x, b.at.y, b.angle_rad, b.length_m);
  });
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    if (ends_[i].is_taken) continue;
    ends_at_corner_.clear();
    for (std::size_t j = i; j < ends_.size() && ends_[j].at.x - ends_[i].at.x <= coinciding_m; ++j) {
      if (ends_[j].is_taken || std::fabs(ends_[j].at.y - ends_[i].at.y) > coinciding_m) continue;
      ends_[j].is_taken = true;
      ends_at_corner_.push_back(ends_[j]);
    }
    WAITPOINT_FAST_CHECK(!ends_at_corner_.empty(), "a point of a cut surface has no segment");
    add_sectors();
  }
}

// Adds the sectors about the point where the ends in here_ meet.
void SurfaceCorners::add_sectors() {
  std::sort(ends_at_corner_.begin(), ends_at_corner_.end(), [](const End& a, const End& b) {
    return std::tie(a.angle_rad, a.length_m) < std::tie(b.angle_rad, b.length_m);
  });
  for (std::size_t i = 0; i < ends_at_corner_.size(); ++i) {
    const bool is_last = i + 1 == ends_at_corner_.size();
    const End &from = ends_at_corner_[i], &to = ends_at_corner_[is_last ? 0 : i + 1];
    WAITPOINT_FAST_CHECK(is_last || from.angle_rad <= to.angle_rad,
                         "the segments at a point are not in order of angle");
    const double wide_rad = to.angle_rad - from.angle_rad + (is_last ? 2 * exact::pi : 0);
    if (wide_rad > exact::pi + turn_rad_min) {
      edges_.push_back({ends_at_corner_[0].at, from.along, to.along});
    } else if (wide_rad < exact::pi && is_corner_of_walls(from.along, to.along) &&
               std::min(from.length_m, to.length_m) > corner_wall_m_min) {
      corners_.push_back({ends_at_corner_[0].at, {-from.along.y, from.along.x}, {to.along.y, -to.along.x}});
    }
  }
}

}  // namespace waitpoint::world
