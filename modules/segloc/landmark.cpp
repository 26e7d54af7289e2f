// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/landmark.hpp"

#include <algorithm>
#include <limits>

namespace waitpoint::segloc {

void Coverage::add(Stretch stretch, double join_m) {
  // Stretches within reach of the new one are joined to it; the others keep their order.
  std::size_t kept = 0;
  for (const Stretch& other : stretches_) {
    if (other.low_m - stretch.high_m <= join_m && stretch.low_m - other.high_m <= join_m) {
      stretch = {std::min(stretch.low_m, other.low_m), std::max(stretch.high_m, other.high_m)};
    } else {
      stretches_[kept++] = other;
    }
  }
  stretches_.resize(kept);
  if (stretches_.full()) join_nearest();
  stretches_.push_back(stretch);
  for (std::size_t i = stretches_.size() - 1; i > 0 && stretches_[i].low_m < stretches_[i - 1].low_m; --i) {
    std::swap(stretches_[i], stretches_[i - 1]);
  }
}

void Coverage::join_nearest() {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < stretches_.size(); ++i) {
    const double gap = stretches_[i + 1].low_m - stretches_[i].high_m;
    if (gap >= least) continue;
    least = gap;
    nearest = i;
  }
  stretches_[nearest].high_m = stretches_[nearest + 1].high_m;
  for (std::size_t i = nearest + 1; i + 1 < stretches_.size(); ++i) stretches_[i] = stretches_[i + 1];
  stretches_.resize(stretches_.size() - 1);
}

double Coverage::gap_m(Stretch stretch) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Stretch& other : stretches_) {
    least = std::min(least, std::max({0.0, other.low_m - stretch.high_m, stretch.low_m - other.high_m}));
  }
  return least;
}

double Coverage::length_m() const {
  double sum = 0;
  for (const Stretch& s : stretches_) sum += s.high_m - s.low_m;
  return sum;
}

Coverage::Stretch stretch_between(const Line& line, Point a, Point b) {
  const double p = line.place(a), q = line.place(b);
  return {std::min(p, q), std::max(p, q)};
}

}  // namespace waitpoint::segloc
