// SPDX-License-Identifier: BSD-3-Clause
// The time of the first contact of two outlines that move along arcs: continuous, so no body passes through another at
// any speed.
//
// Conservative advancement on the exact planar distance, with a bound of second order: at a fraction t of the step, let
// n be the direction from one to the other, and let every pair of core points k be g_k apart along n and approach at
// the rate r_k. The path of a point on an arc of length d and turn a, at most R from the centre of rotation, has a
// second derivative of at most |d a| + a^2 R, so with M the sum of both, g_k - r_k x - M x^2 / 2 is a lower bound of
// the pair's gap a fraction x later. Advancing to the least root over k is safe; for two straight motions it is exact.
//
//   gap          state                                      allowed motion
//   > 1 um       free                                       any, up to the gap of 1 um
//   1/2 .. 1 um  contact: a body stops here                 opens the gap or slides along; closing it is a contact
//   < 1/2 um     never reached by motion                    opens the gap
//
// Bodies that climb also meet in height. Then the greater of the planar and the vertical gap counts: a contact is where
// both are down to 1 um and both would close. So a body may slide along a wall while it climbs, and along a table while
// it rests on it.
//
// A body meets the part of a mesh's triangle within its own heights, which vary if it climbs. An interval of the step
// is tested with all heights of the body in it; an interval with a contact is halved until the heights at its ends
// differ by less than half the gap.
//
// Times are fractions of the step. A contact is defined by the gap, so a stopped body never overlaps another.
#pragma once

#include <optional>

#include "world/arc.hpp"
#include "world/mesh/section.hpp"
#include "world/motion/vertical_gap.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::world {

/// The gap at which a body stops.
inline constexpr double contact_gap_m = 1e-6;
/// The tolerance of that gap: far above the rounding of coordinates, far below the gap.
inline constexpr double contact_tolerance_m = 1e-9;

/// The velocities, in m per step, of a body's points at one instant.
struct PointVelocities {
  Point origin, of_origin;
  double turn_rad = 0;

  Point of(Point p) const {
    return {of_origin.x - turn_rad * (p.y - origin.y), of_origin.y + turn_rad * (p.x - origin.x)};
  }
};

/// An upper bound of the distance of a shape's core points from the origin of its body.
double reach_m(const Shape& shape);
/// An upper bound of the planar path along the arc of any core point of a body with that reach.
inline double path_m(const Arc& arc, double reach_m) {
  return arc.planar_length_m() + std::fabs(arc.turn_rad) * reach_m;
}

/// An outline on its arc, over one step.
class Mover {
 public:
  /// A fixed solid.
  explicit Mover(const Outline& still, const Heights& heights = {}) : start_(still), heights_(heights) {}
  /// A triangle of a mesh, which must outlive the mover; `outline` is its whole projection.
  Mover(const Triangle& surface, const Outline& outline)
      : surface_(&surface), start_(outline), heights_{surface.low_m(), surface.high_m()} {}
  /// A body's shape (given in the body's frame) on the body's arc; `start` is its outline at the arc's start, where the
  /// body is `height_m` above the floor.
  Mover(const Shape& shape, const Outline& start, const Arc& arc, double height_m = 0);

  const Outline& start() const { return start_; }
  Outline at(double fraction) const;
  /// The same body, stopped there.
  Mover stopped_at(double fraction) const {
    const double climb = fraction * climb_m();
    return Mover(at(fraction), {heights_.low_m + climb, heights_.high_m + climb});
  }
  bool moves() const { return arc_.moves(); }
  /// Null for an upright solid.
  const Triangle* surface() const { return surface_; }
  /// At the start.
  const Heights& heights() const { return heights_; }
  double climb_m() const { return arc_.climb_m; }
  /// An upper bound of any core point's planar path in a whole step.
  double path_m() const { return path_m_; }
  /// An upper bound of the second derivative of any core point's path by the fraction, in m.
  double bend_m() const { return bend_m_; }
  /// The planar velocities of its points at that fraction.
  PointVelocities velocities_at(double fraction) const;

 private:
  const Shape* shape_ = nullptr;
  const Triangle* surface_ = nullptr;
  Outline start_;
  Heights heights_;
  Arc arc_;
  double path_m_ = 0, bend_m_ = 0;
};

struct Contact {
  double fraction = 0;
  bool first_closes = false, second_closes = false;  ///< its own motion closes the gap; at least one is true
};

/// The first contact at or after the fraction `from`, in [from, 1); none if there is none before the end of the step.
/// The last bits depend on the order of (a, b), so callers must choose an order that does not depend on names. Only `b`
/// may be a surface.
std::optional<Contact> first_contact(const Mover& a, const Mover& b, double from);

}  // namespace waitpoint::world
