// SPDX-License-Identifier: BSD-3-Clause
#include "world/convex_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace waitpoint::world {
namespace {

// Tolerance: nearer points coincide or are collinear.
constexpr double one_m = 1e-9;

// True if `b` is no corner between `a` and `c`: it coincides with `a`, or is not to the right of the line from a to c.
bool passes_by(Point a, Point b, Point c) {
  const Point way = c - a;
  return length(b - a) <= one_m || cross(way, a - b) <= one_m * length(way);
}

// The lower half of the hull of sorted points, without its last one; of points in reversed order the upper half.
// (Andrew, "Another efficient algorithm for convex hulls in two dimensions", Information Processing Letters 9, 1979.)
template <class Iterator>
void add_half(Iterator begin, Iterator end, std::vector<Point>& hull) {
  const std::size_t first = hull.size();
  for (Iterator p = begin; p != end; ++p) {
    while (hull.size() >= first + 2 && passes_by(hull[hull.size() - 2], hull.back(), *p)) hull.pop_back();
    hull.push_back(*p);
  }
  hull.pop_back();
}

// Removes corners that are none, also where the two halves meet.
void drop_needless(std::vector<Point>& corners) {
  for (std::size_t kept = 0, i = 0; corners.size() > 2 && kept < corners.size();) {
    const std::size_t n = corners.size();
    i %= n;
    if (passes_by(corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n])) {
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
      kept = 0;
    } else {
      ++kept;
      ++i;
    }
  }
}

// The omission of a side: the intersection of its neighbours, and the area that this adds.
struct Omission {
  double area_m2 = HUGE_VAL;
  Point meeting;
};

Omission omission(const std::vector<Point>& corners, std::size_t side) {
  const std::size_t n = corners.size();
  const Point start = corners[side], end = corners[(side + 1) % n];
  const Point before = start - corners[(side + n - 1) % n], after = corners[(side + 2) % n] - end;
  const double turn = cross(before, after);
  if (turn <= one_m * length(before) * length(after)) return {};
  const Point meeting = start + (cross(end - start, after) / turn) * before;
  return {0.5 * cross(meeting - start, end - start), meeting};
}

void enclose_by_fewer(std::vector<Point>& corners) {
  std::vector<Omission> omissions;
  for (std::size_t i = 0; i < corners.size(); ++i) omissions.push_back(omission(corners, i));
  while (corners.size() > ConvexPolygon::corners_max) {
    const auto least = std::min_element(omissions.begin(), omissions.end(),
                                        [](const Omission& a, const Omission& b) { return a.area_m2 < b.area_m2; });
    const auto side = static_cast<std::size_t>(least - omissions.begin()), next = (side + 1) % corners.size();
    corners[side] = least->meeting;
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(next));
    omissions.erase(omissions.begin() + static_cast<std::ptrdiff_t>(next));
    const std::size_t n = corners.size(), at = next < side ? side - 1 : side;
    for (const std::size_t i : {(at + n - 1) % n, at}) omissions[i] = omission(corners, i);
  }
}

Point unit_across(Point along) {
  const double length_m = length(along);
  return {along.y / length_m, -along.x / length_m};
}

double width_m(std::span<const ConvexPolygon::Side> sides) {
  double least = HUGE_VAL;
  for (const ConvexPolygon::Side& side : sides) {
    double farthest = 0;
    for (const ConvexPolygon::Side& corner : sides)
      farthest = std::max(farthest, side.beyond_m - dot(side.outward, corner.start));
    least = std::min(least, farthest);
  }
  return least;
}

}  // namespace

ConvexPolygon::ConvexPolygon(std::span<const Point> corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point start = corners[i], outward = unit_across(corners[(i + 1) % corners.size()] - start);
    sides_.push_back({start, outward, dot(outward, start)});
    half_size_ = {std::max(half_size_.x, std::fabs(start.x)), std::max(half_size_.y, std::fabs(start.y))};
  }
}

double ConvexPolygon::mean_square_m2() const {
  double moment = 0, twice_area = 0;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Point p = sides_[i].start, q = sides_[(i + 1) % sides_.size()].start;
    const double part = cross(p, q);
    twice_area += part;
    moment += part * (dot(p, p) + dot(p, q) + dot(q, q));
  }
  return moment / (6 * twice_area);
}

std::optional<PlacedPolygon> hull_of(std::vector<Point> points, double width_m_min) {
  if (points.empty()) return std::nullopt;
  std::sort(points.begin(), points.end(), [](Point a, Point b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  std::vector<Point> corners;
  add_half(points.begin(), points.end(), corners);
  add_half(points.rbegin(), points.rend(), corners);
  drop_needless(corners);
  if (corners.size() < 3) return std::nullopt;
  enclose_by_fewer(corners);
  Point low = corners[0], high = corners[0];
  for (const Point p : corners) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Point origin = 0.5 * (low + high);
  for (Point& p : corners) p = p - origin;
  auto polygon = std::make_shared<const ConvexPolygon>(corners);
  if (width_m(polygon->sides()) < width_m_min) return std::nullopt;
  return PlacedPolygon{origin, std::move(polygon)};
}

}  // namespace waitpoint::world
