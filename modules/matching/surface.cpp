// SPDX-License-Identifier: BSD-3-Clause
#include "modules/matching/surface.hpp"

#include <cmath>

namespace waitpoint::matching {
namespace {

struct Echo {
  Point position;
  std::uint32_t beam;
};

// The normal of the line through the neighbours of an echo: those up to `reach` along the surface to each side, at
// least one and at most four.
Point normal_at(const std::vector<Echo>& echoes, std::size_t i, const SurfaceParameters& parameters) {
  const auto joined = [&](std::size_t a, std::size_t b) {
    return echoes[b].beam - echoes[a].beam <= 2 && length(echoes[b].position - echoes[a].position) <= parameters.jump_m;
  };
  std::size_t first = i, last = i;
  while (first > 0 && i - first < 4 && joined(first - 1, first)) {
    --first;
    if (length(echoes[first].position - echoes[i].position) >= parameters.reach_m) break;
  }
  while (last + 1 < echoes.size() && last - i < 4 && joined(last, last + 1)) {
    ++last;
    if (length(echoes[last].position - echoes[i].position) >= parameters.reach_m) break;
  }
  if (last - first < 2) return {};
  const double n = static_cast<double>(last - first + 1);
  Point mean;
  for (std::size_t k = first; k <= last; ++k) mean = mean + echoes[k].position;
  mean = (1 / n) * mean;
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t k = first; k <= last; ++k) {
    const Point d = echoes[k].position - mean;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  const double half = 0.5 * (xx - yy), size = std::sqrt(half * half + xy * xy), mid = 0.5 * (xx + yy);
  if (mid - size > 0.1 * (mid + size)) return {};  // scattered: no surface
  // The direction of least scatter: the eigenvector of mid - size, from the longer of its two forms.
  const Point a{xy, -half - size}, b{half - size, xy};
  const double la = length(a), lb = length(b);
  if (la == 0 && lb == 0) return {};
  return la > lb ? (1 / la) * a : (1 / lb) * b;
}

}  // namespace

void surface_of(const posters::Echoes& echoes, const SurfaceParameters& parameters, std::vector<SurfacePoint>& points) {
  points.clear();
  const posters::LaserReading& scan = echoes.scan;
  const double range_m_max = std::min(parameters.range_m_max, scan.range_max_m - 0.01);
  std::vector<Echo> seen;
  seen.reserve(scan.range_m.size());
  for (std::uint32_t beam = 0; beam < scan.range_m.size(); ++beam) {
    const double range = scan.range_m[beam];
    if (!(range >= parameters.range_m_min && range < range_m_max)) continue;
    const auto [sine, cosine] = exact::sincos(scan.first_angle_rad + beam * scan.angle_step_rad);
    seen.push_back({{range * cosine, range * sine}, beam});
  }
  const auto [sine, cosine] = exact::sincos(echoes.mount.heading);
  const Point* kept = nullptr;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Point p = seen[i].position;
    if (kept != nullptr && length(p - *kept) < parameters.spacing_m) continue;
    kept = &seen[i].position;
    Point normal = normal_at(seen, i, parameters);
    if (dot(normal, p) > 0) normal = {-normal.x, -normal.y};
    points.push_back({{echoes.mount.x + (cosine * p.x - sine * p.y), echoes.mount.y + (sine * p.x + cosine * p.y)},
                      {cosine * normal.x - sine * normal.y, sine * normal.x + cosine * normal.y}});
  }
}

}  // namespace waitpoint::matching
