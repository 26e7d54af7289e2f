// SPDX-License-Identifier: BSD-3-Clause
// When two outlines that move along arcs first touch, so that nothing passes through anything at any speed.
//
// Conservative advancement on the exact planar distance, with a bound of second order: at a fraction t of the step, let
// n be the direction from one to the other, and let every pair of core points k be g_k apart along n and approach at
// the rate r_k. A point on an arc of length d and turn a, at most R from the centre of rotation, bends by at most
// |d a| + a^2 R, so with M the sum of both, g_k - r_k x - M x^2 / 2 is a lower bound of the pair's gap a fraction x
// later. The least root over k is safe to advance to; where both move straight it is the answer at once.
//
//   gap          what is there                              what a motion may do
//   > 1 um       free                                       all, up to the gap of 1 um
//   1/2 .. 1 um  contact: a body stops here                 open the gap or slide along; what closes it is a contact
//   < 1/2 um     never reached by motion                    open the gap
//
// Who climbs meets others in height too. What counts then is the greater of the two gaps, in the plane and in height: a
// contact is where both are down to 1 um, and neither can go on without closing. So a body may slide along a wall while
// it climbs, and along a table while it stands on it.
//
// Of a mesh's triangle, what is met is the part within the body's heights. Who climbs has others at every moment: what
// is within those of a stretch of the step holds a contact, or none; a stretch with one is halved until the heights of
// its ends are less than half the gap apart.
//
// Times are fractions of the step. Touching is told by the gap, so that a stopped body is never found inside another.
#pragma once

#include <optional>

#include "world/arc.hpp"
#include "world/mesh/section.hpp"
#include "world/motion/vertical_gap.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::world {

/// A body stops this much before it would touch.
inline constexpr double contact_gap_m = 1e-6;
/// How exactly it stops there. Far above the rounding of coordinates, far below the gap.
inline constexpr double contact_tolerance_m = 1e-9;

/// The velocities, in m per step, of all points of a body at one moment.
struct PointVelocities {
  Point origin, of_origin;
  double turn_rad = 0;

  Point of(Point p) const {
    return {of_origin.x - turn_rad * (p.y - origin.y), of_origin.y + turn_rad * (p.x - origin.x)};
  }
};

/// No point of a shape that is fixed to a body is farther than this from the body's origin.
double reach_m(const Shape& shape);
/// No point of a body of that reach moves further than this in the plane along the arc.
inline double path_m(const Arc& arc, double reach_m) {
  return arc.planar_length_m() + std::fabs(arc.turn_rad) * reach_m;
}

/// An outline on its arc, over one step.
class Mover {
 public:
  /// Something that stands still during the step.
  explicit Mover(const Outline& still, const Heights& heights = {}) : start_(still), heights_(heights) {}
  /// A triangle of a mesh, which must outlive it; `outline` is that of all of it.
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
  /// Null for what is upright.
  const Triangle* surface() const { return surface_; }
  /// At the start.
  const Heights& heights() const { return heights_; }
  double climb_m() const { return arc_.climb_m; }
  /// No point moves further than this in the plane in a whole step.
  double path_m() const { return path_m_; }
  /// No point's path, as a function of the fraction, has a second derivative above this, in m.
  double bend_m() const { return bend_m_; }
  /// How its points move in the plane at that fraction.
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
  bool first_closes = false, second_closes = false;  ///< whose own motion closes the gap; one of them does
};

/// The first contact at or after the fraction `from`; none if there is none before the end of the step.
/// For the same bits whatever the bodies are called, ask for (a, b) in an order that does not depend on names. Only `b`
/// may be a surface.
std::optional<Contact> first_contact(const Mover& a, const Mover& b, double from);

}  // namespace waitpoint::world
