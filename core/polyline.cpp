// SPDX-License-Identifier: BSD-3-Clause
#include "core/polyline.hpp"

#include <algorithm>
#include <utility>

namespace waitpoint {
namespace {

double distance_to_segment(Point p, Point a, Point b) {
  const Point along = b - a;
  const double squared = dot(along, along);
  const double part = squared > 0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0;
  return length(p - (a + part * along));
}

}  // namespace

std::vector<std::size_t> simplified(std::span<const Point> line, double tolerance) {
  std::vector<bool> kept(line.size(), line.size() < 3);
  std::vector<std::pair<std::size_t, std::size_t>> open;
  if (line.size() >= 3) {
    kept.front() = kept.back() = true;
    open.push_back({0, line.size() - 1});
  }
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    std::size_t farthest = first;
    double greatest = tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double distance = distance_to_segment(line[i], line[first], line[last]);
      if (!(distance > greatest)) continue;  // nor is a point kept that is not a number
      greatest = distance;
      farthest = i;
    }
    if (farthest == first) continue;
    kept[farthest] = true;
    open.push_back({first, farthest});
    open.push_back({farthest, last});
  }
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (kept[i]) result.push_back(i);
  return result;
}

}  // namespace waitpoint
