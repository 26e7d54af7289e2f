// SPDX-License-Identifier: BSD-3-Clause
// Sonars with specular reflection: a smooth wall is a mirror to sound, so an echo differs from the hit of a ray.
//
//   wall            echoes if the perpendicular on it from the transducer lies in the cone and on the wall; the range
//                   is the perpendicular distance, not that along the axis
//   cylinder        always has a surface facing the transducer: echoes if the direction to its axis lies in the cone
//   concave corner  is a retroreflector: echoes over the whole cone
//   convex edge     diffracts weakly: echoes in the inner half of the cone, up to half of the greatest range
//
// After Kuc and Siegel (1987), simplified: each is either heard or not, the nearest visible one counts, echoes of more
// than one reflection are left out, and only walls that meet at nearly a right angle make a concave corner. Crosstalk
// between transducers: world/sensors/sonar_crosstalk.hpp.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/random.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::world {

/// A possible echo of a transducer: heard if its path is free.
struct Echo {
  double distance_m = 0;
  Point direction;  ///< from the transducer, unit vector
};

/// A concave corner of two walls, which reflects sound back; the normals point into the free space.
struct ConcaveCorner {
  Point at, normal_1, normal_2;
};
/// True if the angle between two walls with these unit directions is nearly right, as a concave corner requires.
inline bool is_corner_of_walls(Point along_1, Point along_2) { return std::fabs(dot(along_1, along_2)) <= 0.1; }
/// The least length of each wall of a concave corner.
inline constexpr double corner_wall_m_min = 5e-3;

/// A side of a box or a polygon, with its outward unit normal.
struct Face {
  Point start, end, normal;
};
std::array<Face, 4> faces_of(const Outline& box);

/// Calls `visit(face)` for all sides of a box or a polygon; not at all for a disc.
template <class Visit>
void visit_faces(const Outline& outline, Visit visit) {
  if (outline.is_box)
    for (const Face& face : faces_of(outline)) visit(face);
  if (outline.polygon == nullptr) return;
  const CorePoints corners = core_points(outline);
  for (std::size_t i = 0; i < corners.count(); ++i)
    visit(Face{corners[i], corners[(i + 1) % corners.count()], outline.outward(outline.polygon->sides()[i].outward)});
}

/// The field of one transducer: finds the possible echoes of outlines, corners and edges.
class SonarCone {
 public:
  SonarCone(const SonarRingDescription& ring, const Pose& transducer);

  /// Appends the possible echoes of an outline, of a corner.
  void add(const Outline& outline, std::vector<Echo>& echoes) const;
  void add(const ConcaveCorner& corner, std::vector<Echo>& echoes) const;
  /// Of a segment of a surface: a wall on both sides.
  void add_surface(const Outline& segment, std::vector<Echo>& echoes) const;
  /// Of a convex edge that faces the transducer.
  void add_edge(Point edge, std::vector<Echo>& echoes) const {
    add_point(edge, cosine_half_, 0.5 * range_max_m_, echoes);
  }

  Point origin() const { return origin_; }
  Point axis() const { return axis_; }
  double half_cone_rad() const { return half_cone_rad_; }
  double range_max_m() const { return range_max_m_; }
  /// True if the point lies in the cone.
  bool looks_at(Point p) const { return dot(p - origin_, axis_) >= cosine_whole_ * length(p - origin_); }

 private:
  void add_faces(const Outline& outline, std::vector<Echo>& echoes) const;
  void add_wall(const Face& wall, std::vector<Echo>& echoes) const;
  void add_point(Point p, double cosine_min, double range_max_m, std::vector<Echo>& echoes) const;

  Point origin_, axis_;
  double cosine_whole_, cosine_half_;  // of the cone's half angle, and of half of that
  double half_cone_rad_, range_max_m_;
};

/// The concave corners between two boxes that touch or overlap; appends to `corners`.
void find_concave_corners(const Outline& a, const Outline& b, std::vector<ConcaveCorner>& corners);

/// The speed of sound in air.
double sound_m_s(double celsius);

/// The measured range of an echo at `distance_m` (infinite: none), given a standard normal draw: computed with the
/// speed of sound for which the ring is calibrated.
double sonar_range_m(const SonarRingDescription& ring, double distance_m, double normal);

/// The stream (seed, robot, "sonar <number>.range") of a ring's noise: tick = number of the firing, index = transducer.
RandomStream sonar_noise(std::uint64_t seed, std::string_view robot, std::size_t number);

}  // namespace waitpoint::world
