// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/route.hpp"

#include "core/error.hpp"

namespace waitpoint::ndd {
namespace {

constexpr double beyond_m_max = 1.2;
constexpr double close_share = 0.5;  // of the tolerance: as near as this, corners are cut

}  // namespace

void Route::start(Point from, std::span<const Point> via_points) {
  points_.clear();
  if (via_points.empty()) return;
  points_.push_back(from);
  points_.insert(points_.end(), via_points.begin(), via_points.end());
  next_ = 1;
}

void Route::advance(Point robot, double via_tolerance_m, const std::function<bool(Point)>& is_clear) {
  while (!empty() && !target_is_last()) {
    const Point leg = points_[next_] - points_[next_ - 1], beyond = robot - points_[next_];
    const double distance = length(beyond);
    const bool past = dot(leg, beyond) > 0 && distance < beyond_m_max;
    if (distance >= via_tolerance_m && !past) return;
    const bool is_close = past || distance < close_share * via_tolerance_m;
    if (!is_close && is_clear && !is_clear(points_[next_ + 1])) return;
    ++next_;
  }
}

Point Route::target() const {
  WAITPOINT_CHECK(!empty(), "no route");
  return points_[next_];
}

double Route::remaining_m(Point robot) const {
  if (empty()) return 0;
  double sum = length(points_[next_] - robot);
  for (std::size_t i = next_; i + 1 < points_.size(); ++i) sum += length(points_[i + 1] - points_[i]);
  return sum;
}

}  // namespace waitpoint::ndd
