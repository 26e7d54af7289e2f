// SPDX-License-Identifier: BSD-3-Clause
// Sonars with specular reflection: a smooth wall is a mirror to sound, so what answers is not what a ray hits.
//
//   wall            answers if the perpendicular on it from the transducer lies in the cone and on the wall; the range
//                   is the perpendicular distance, not that along the axis
//   cylinder        always has a surface facing the transducer: answers if the direction to its axis lies in the cone
//   concave corner  sends sound back where it came from: answers over the whole cone
//   convex edge     diffracts weakly: answers in the inner half of the cone, up to half of the greatest range
//
// After Kuc and Siegel (1987), simplified: each is either heard or not, the nearest visible one counts, echoes of more
// than one reflection are left out, and only walls that meet at nearly a right angle make a concave corner. What one
// transducer hears of another: world/sensors/sonar_crosstalk.hpp.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/random.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::world {

/// Something that would answer a transducer if nothing stood before it.
struct Echo {
  double distance_m = 0;
  Point direction;  ///< from the transducer, of length 1
};

/// Where two walls meet so that sound is thrown back; the normals point into the free space before it.
struct ConcaveCorner {
  Point at, normal_1, normal_2;
};
/// Walls that go off in these directions make a corner only if the angle between them is nearly right.
inline bool is_corner_of_walls(Point along_1, Point along_2) { return std::fabs(dot(along_1, along_2)) <= 0.1; }
/// And each must go on beyond it by this.
inline constexpr double corner_wall_m_min = 5e-3;

/// A side of a box or a polygon, its normal out of it.
struct Face {
  Point start, end, normal;
};
std::array<Face, 4> faces_of(const Outline& box);

/// Shows all sides of a box or a polygon; nothing of a disc, which has none.
template <class Visit>
void visit_faces(const Outline& outline, Visit visit) {
  if (outline.is_box)
    for (const Face& face : faces_of(outline)) visit(face);
  if (outline.polygon == nullptr) return;
  const CorePoints corners = core_points(outline);
  for (std::size_t i = 0; i < corners.count(); ++i)
    visit(Face{corners[i], corners[(i + 1) % corners.count()], outline.outward(outline.polygon->sides()[i].outward)});
}

/// One transducer's field: what of the things it is shown answers.
class SonarCone {
 public:
  SonarCone(const SonarRingDescription& ring, const Pose& transducer);

  /// Shows an outline; appends its possible echoes.
  void add(const Outline& outline, std::vector<Echo>& echoes) const;
  void add(const ConcaveCorner& corner, std::vector<Echo>& echoes) const;
  /// Shows a segment of a surface: its walls, on both sides.
  void add_surface(const Outline& segment, std::vector<Echo>& echoes) const;
  /// Shows an edge that the transducer is before.
  void add_edge(Point edge, std::vector<Echo>& echoes) const {
    add_point(edge, cosine_half_, 0.5 * range_max_m_, echoes);
  }

  Point origin() const { return origin_; }
  Point axis() const { return axis_; }
  double half_cone_rad() const { return half_cone_rad_; }
  double range_max_m() const { return range_max_m_; }
  /// Whether the point lies in the cone.
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

/// The transducer's pose in the body's frame.
Pose transducer_mount(const SonarRingDescription& ring, std::uint32_t transducer);

/// How many groups of a ring take turns, and whether a transducer's group has its turn in the firing of that number.
std::uint64_t slots(const SonarRingDescription& ring);
bool fires(const SonarRingDescription& ring, std::uint32_t transducer, std::uint64_t firing);

/// The speed of sound in air.
double sound_m_s(double celsius);

/// The measured range of an echo at `distance_m` (infinite: none), given a standard normal draw: computed with the
/// speed of sound that the ring is calibrated for.
double sonar_range_m(const SonarRingDescription& ring, double distance_m, double normal);

/// The stream (seed, robot, "sonar <number>.range") of a ring's noise: tick = number of the firing, index = transducer.
RandomStream sonar_noise(std::uint64_t seed, std::string_view robot, std::size_t number);

}  // namespace waitpoint::world
