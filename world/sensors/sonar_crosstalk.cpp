// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/sonar_crosstalk.hpp"

#include <algorithm>

namespace waitpoint::world {
namespace {

Point unit(Point v) { return (1 / length(v)) * v; }

void add_by_way_of(Point at, const SonarCone& emitter, const SonarCone& listener, std::vector<CrossEcho>& echoes) {
  if (!emitter.looks_at(at) || !listener.looks_at(at)) return;
  const double distance_m = 0.5 * (length(at - emitter.origin()) + length(at - listener.origin()));
  if (distance_m <= listener.range_max_m()) echoes.push_back({distance_m, at});
}

}  // namespace

bool may_hear(const SonarCone& listener, const SonarCone& emitter) {
  const double both_rad = listener.half_cone_rad() + emitter.half_cone_rad();
  return both_rad >= exact::pi || dot(listener.axis(), emitter.axis()) >= exact::cos(both_rad);
}

void add_cross_echoes(const SonarCone& emitter, const SonarCone& listener, const Outline& outline,
                      std::vector<CrossEcho>& echoes) {
  const Point a = emitter.origin(), b = listener.origin();
  if (!outline.is_box && outline.polygon == nullptr) {
    const Point to_a = a - outline.centre, to_b = b - outline.centre;
    if (std::min(length(to_a), length(to_b)) <= outline.radius_m) return;
    const Point middle = unit(to_a) + unit(to_b);
    if (length(middle) > 0) add_by_way_of(outline.centre + outline.radius_m * unit(middle), emitter, listener, echoes);
    return;
  }
  visit_faces(outline, [&](const Face& face) {
    const double height_a = dot(a - face.start, face.normal), height_b = dot(b - face.start, face.normal);
    if (height_a <= 0 || height_b <= 0) return;
    const Point foot_a = a - height_a * face.normal, foot_b = b - height_b * face.normal;
    const Point at = foot_a + (height_a / (height_a + height_b)) * (foot_b - foot_a);
    const Point edge = face.end - face.start;
    const double along = dot(at - face.start, edge);
    if (edge == Point{}) return;  // of a segment
    if (along >= 0 && along <= dot(edge, edge)) add_by_way_of(at, emitter, listener, echoes);
  });
}

void add_cross_echoes(const SonarCone& emitter, const SonarCone& listener, const ConcaveCorner& corner,
                      std::vector<CrossEcho>& echoes) {
  for (const Point origin : {emitter.origin(), listener.origin()}) {
    if (dot(origin - corner.at, corner.normal_1) <= 0 || dot(origin - corner.at, corner.normal_2) <= 0) return;
  }
  add_by_way_of(corner.at, emitter, listener, echoes);
}

}  // namespace waitpoint::world
