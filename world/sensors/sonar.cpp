// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/sonar.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"

namespace waitpoint::world {
namespace {

// The greatest gap between two walls that make a corner.
constexpr double meeting_m = 1e-6;

bool on_face(const Face& face, Point p) {
  const Point edge = face.end - face.start;
  const double along = dot(p - face.start, edge), across = dot(p - face.start, face.normal);
  const double span = dot(edge, edge), margin = meeting_m * std::sqrt(span);
  return std::fabs(across) <= meeting_m && along >= -margin && along <= span + margin;
}

}  // namespace

std::array<Face, 4> faces_of(const Outline& box) {
  const CorePoints p = core_points(box);
  const Point along = box.outward({1, 0}), across = box.outward({0, 1});
  const Point back = {-along.x, -along.y}, right = {-across.x, -across.y};
  return {{{p[0], p[1], across}, {p[1], p[2], back}, {p[2], p[3], right}, {p[3], p[0], along}}};
}

SonarCone::SonarCone(const SonarRingDescription& ring, const Pose& transducer)
    : origin_(transducer.position()),
      cosine_whole_(exact::cos(ring.half_cone_rad)),
      cosine_half_(exact::cos(0.5 * ring.half_cone_rad)),
      half_cone_rad_(ring.half_cone_rad),
      range_max_m_(ring.range_max_m) {
  const auto [s, c] = exact::sincos(transducer.heading);
  axis_ = {c, s};
}

void SonarCone::add_point(Point p, double cosine_min, double range_max_m, std::vector<Echo>& echoes) const {
  const Point d = p - origin_;
  const double distance = length(d);
  if (distance == 0 || distance > range_max_m || dot(d, axis_) < cosine_min * distance) return;
  echoes.push_back({distance, {d.x / distance, d.y / distance}});
}

void SonarCone::add_wall(const Face& wall, std::vector<Echo>& echoes) const {
  const double height = dot(origin_ - wall.start, wall.normal);
  if (height <= 0 || height > range_max_m_ || -dot(wall.normal, axis_) < cosine_whole_) return;
  const Point edge = wall.end - wall.start;
  const double along = dot(origin_ - wall.start, edge);
  if (along >= 0 && along <= dot(edge, edge)) echoes.push_back({height, {-wall.normal.x, -wall.normal.y}});
}

void SonarCone::add_surface(const Outline& segment, std::vector<Echo>& echoes) const {
  const std::array<Face, 4> faces = faces_of(segment);
  add_wall(faces[0], echoes);
  add_wall(faces[2], echoes);
}

void SonarCone::add_faces(const Outline& outline, std::vector<Echo>& echoes) const {
  visit_faces(outline, [&](const Face& face) {
    add_wall(face, echoes);
    add_edge(face.start, echoes);
  });
}

void SonarCone::add(const Outline& outline, std::vector<Echo>& echoes) const {
  // A quick rejection of outlines wholly behind or beyond the range.
  const double extent = outline.half_length_m + outline.half_width_m + outline.radius_m;
  const Point d = outline.centre - origin_;
  if (dot(d, axis_) < -extent || dot(d, d) > (range_max_m_ + extent) * (range_max_m_ + extent)) return;
  if (outline.is_box || outline.polygon != nullptr) return add_faces(outline, echoes);
  const std::size_t before = echoes.size();
  add_point(outline.centre, cosine_whole_, range_max_m_ + outline.radius_m, echoes);
  if (echoes.size() > before) echoes.back().distance_m = std::max(echoes.back().distance_m - outline.radius_m, 0.0);
}

void SonarCone::add(const ConcaveCorner& corner, std::vector<Echo>& echoes) const {
  const Point d = origin_ - corner.at;
  if (dot(d, corner.normal_1) <= 0 || dot(d, corner.normal_2) <= 0) return;
  add_point(corner.at, cosine_whole_, range_max_m_, echoes);
}

void find_concave_corners(const Outline& a, const Outline& b, std::vector<ConcaveCorner>& corners) {
  for (const Face& f : faces_of(a)) {
    for (const Face& g : faces_of(b)) {
      if (!is_corner_of_walls(f.normal, g.normal)) continue;
      // The lines of the two faces meet at f.start + t (f.end - f.start).
      const Point edge = f.end - f.start;
      const double slope = dot(edge, g.normal);
      if (slope == 0) continue;
      const Point p = f.start + (dot(g.start - f.start, g.normal) / slope) * edge;
      // Each wall must extend in front of the other, else there is no concave corner.
      if (on_face(f, p) && on_face(g, p) && on_face(f, p + corner_wall_m_min * g.normal) &&
          on_face(g, p + corner_wall_m_min * f.normal)) {
        corners.push_back({p, f.normal, g.normal});
      }
    }
  }
}

double sound_m_s(double celsius) { return 331.3 + 0.606 * celsius; }

double sonar_range_m(const SonarRingDescription& ring, double distance_m, double normal) {
  WAITPOINT_CHECK(0 <= ring.range_min_m && ring.range_min_m <= ring.range_max_m,
                  "a sonar ring's least range is negative, or above its greatest");
  WAITPOINT_FAST_CHECK(distance_m >= 0, "the distance of an echo is negative or NaN");
  if (distance_m > ring.range_max_m) return ring.range_max_m;
  const double taken_for = sound_m_s(ring.calibrated_celsius) / sound_m_s(ring.air_celsius);
  const double range = taken_for * distance_m * (1 + ring.range_noise_relative * normal);
  return std::clamp(range, ring.range_min_m, ring.range_max_m);
}

RandomStream sonar_noise(std::uint64_t seed, std::string_view robot, std::size_t number) {
  return RandomStream(seed, robot, "sonar " + std::to_string(number) + ".range");
}

}  // namespace waitpoint::world
