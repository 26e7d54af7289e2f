// SPDX-License-Identifier: BSD-3-Clause
#include "world/mesh/band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "world/slice/overlap_walk.hpp"

namespace waitpoint::world {
namespace {

double square(double value) { return value * value; }

double square_to_segment(Point start, Point end, Point p) {
  const Point along = end - start, to = p - start;
  const double part = std::min(std::max(dot(to, along) / dot(along, along), 0.0), 1.0);
  const Point beside = to - part * along;
  return dot(beside, beside);
}

// True if the disc overlaps the part, a segment or a triangle. Without roots, unless rounding may decide.
bool overlaps(const Outline& disc, const Outline& part) {
  constexpr double rounding_m = 1e-6;
  const double apart_m2 = square(disc.radius_m + rounding_m);
  const double together_m2 = square(std::max(disc.radius_m - rounding_m, 0.0));
  const Point p = part.local(disc.centre);
  const double l = part.half_length_m, w = part.half_width_m;
  const double beyond_m2 = square(std::max(std::fabs(p.x) - l, 0.0));
  if (beyond_m2 + square(std::max(std::fabs(p.y) - w, 0.0)) > apart_m2) return false;
  // To the longest side, which is all of a segment.
  if (beyond_m2 + square(p.y + w) < together_m2) return true;
  if (part.is_triangle) {
    const Point apex = {part.apex_m, w}, start = {-l, -w}, end = {l, -w};
    const bool inside = p.y >= -w && cross(apex - end, p - end) >= 0 && cross(start - apex, p - apex) >= 0;
    const double rest_m2 = std::min(square_to_segment(end, apex, p), square_to_segment(apex, start, p));
    if ((inside && together_m2 > 0) || rest_m2 < together_m2) return true;
    if (!inside && std::min(rest_m2, beyond_m2 + square(p.y + w)) > apart_m2) return false;
  }
  return separation(disc, part).distance_m < 0;
}

}  // namespace

Band::Band(const Surfaces& surfaces, double z_low_m, double z_high_m)
    : z_low_m_(z_low_m), z_high_m_(z_high_m), tree_(std::span<const Bounds>()) {
  WAITPOINT_CHECK(z_low_m <= z_high_m, "a band of surfaces ends below its lower height");
  std::vector<Outline> parts;
  std::vector<std::uint32_t> triangles;
  std::vector<Bounds> bounds;
  for (std::uint32_t number = 0; number < surfaces.size(); ++number) {
    first_of_.push_back(static_cast<std::uint32_t>(parts.size()));
    cover(surfaces.triangle(number), z_low_m, z_high_m, parts);
    triangles.resize(parts.size(), number);
  }
  first_of_.push_back(static_cast<std::uint32_t>(parts.size()));
  for (const Outline& part : parts) bounds.push_back(bounds_of(part));
  tree_ = Tree(bounds);
  by_triangle_.resize(parts.size());
  for (const std::uint32_t part : tree_.number_by_nodes()) {
    by_triangle_[part] = static_cast<std::uint32_t>(parts_.size());
    parts_.push_back(parts[part]);
    triangles_.push_back(triangles[part]);
  }
}

template <class Visit>
void Band::visit(const Bounds& bounds, Visit visit) const {
  walk_overlapping(tree_.nodes(), {bounds.low - tree_.middle(), bounds.high - tree_.middle()},
                   float_margin_m(tree_.extent_m()), kernels(), visit);
}

void Band::near(const Bounds& bounds, std::vector<std::uint32_t>& found) const {
  found.clear();
  visit(bounds, [&](std::uint32_t part) {
    found.push_back(triangles_[part]);
    return true;
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

double Band::separation_m(const Outline& body, std::uint32_t number) const {
  WAITPOINT_FAST_CHECK(number + 1 < first_of_.size(), "the separation of a triangle that does not exist is asked for");
  double least_m = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = first_of_[number]; i < first_of_[number + 1]; ++i)
    least_m = std::min(least_m, separation(body, parts_[by_triangle_[i]]).distance_m);
  return least_m;
}

bool Band::collides(const Outline& body) const {
  const bool is_disc = !body.is_box && !body.is_triangle && body.polygon == nullptr;
  bool met = false;
  visit(bounds_of(body), [&](std::uint32_t part) {
    met = is_disc ? overlaps(body, parts_[part]) : separation(body, parts_[part]).distance_m < 0;
    return !met;
  });
  return met;
}

}  // namespace waitpoint::world
