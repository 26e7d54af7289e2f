// SPDX-License-Identifier: BSD-3-Clause
#include "modules/locate/panorama.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace waitpoint::locate {

bool Panorama::add(const Pose& odometry, std::span<const matching::SurfacePoint> scan) {
  if (!views_.empty()) {
    const Pose moved = between(views_.back().odometry, odometry);
    if (std::fabs(moved.heading) < parameters_.view_turn_rad && length(moved.position()) < parameters_.view_travel_m)
      return false;
  }
  if (views_.size() == parameters_.views_max) views_.pop_front();
  views_.push_back({odometry, {scan.begin(), scan.end()}});
  return true;
}

std::vector<matching::SurfacePoint> Panorama::points(double spacing_m) const {
  struct InSquare {
    std::int64_t x, y;
    matching::SurfacePoint point;
  };
  std::vector<InSquare> all;
  for (const View& view : views_) {
    const Pose seen_from = between(views_.back().odometry, view.odometry);
    const Pose turn = {0, 0, seen_from.heading};
    for (const matching::SurfacePoint& p : view.points) {
      const Point at = transform(seen_from, p.position);
      all.push_back({static_cast<std::int64_t>(std::floor(at.x / spacing_m)),
                     static_cast<std::int64_t>(std::floor(at.y / spacing_m)),
                     {at, transform(turn, p.normal)}});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const InSquare& a, const InSquare& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  std::vector<matching::SurfacePoint> points;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i == 0 || all[i].x != all[i - 1].x || all[i].y != all[i - 1].y) points.push_back(all[i].point);
  return points;
}

}  // namespace waitpoint::locate
