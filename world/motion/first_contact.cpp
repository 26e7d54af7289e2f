// SPDX-License-Identifier: BSD-3-Clause
#include "world/motion/first_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"

namespace waitpoint::world {
namespace {

constexpr double least_gap_m = 0.5 * contact_gap_m;
// Each round advances by at least contact_tolerance_m / path, and by far more with the bound of second order. A motion
// that needs more rounds than this (none is known) counts as a contact, which is safe.
constexpr int rounds_max = 100000;

// The core points of one side along the normal: the distance of each behind the foremost point (0 for that one), and
// its velocity towards the other side, in m per step.
struct Reach {
  struct Item {
    double behind_m, towards_m;
  };
  std::array<Item, ConvexPolygon::corners_max> items;
  std::size_t count = 0;

  // The fastest approach among the foremost points, up to rounding.
  double closing_m() const {
    double closing = -HUGE_VAL;
    for (std::size_t i = 0; i < count; ++i) {
      if (items[i].behind_m <= contact_tolerance_m) closing = std::max(closing, items[i].towards_m);
    }
    return closing;
  }
};

// Without points farther behind than both sides can approach by the bounds on their motions.
Reach reach_along(const Mover& mover, const Outline& outline, double fraction, Point normal, double approach_m_max) {
  Reach reach;
  if (!mover.moves()) {
    reach.items[0] = {0, 0};
    reach.count = 1;
    return reach;
  }
  const PointVelocities velocities = mover.velocities_at(fraction);
  double foremost = -HUGE_VAL;
  const CorePoints points = core_points(outline);
  WAITPOINT_CHECK(points.count() <= reach.items.size(), "a core has more points than a polygon has corners at most");
  for (const Point p : points) {
    const double along = dot(normal, p);
    foremost = std::max(foremost, along);
    reach.items[reach.count++] = {along, dot(normal, velocities.of(p))};
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < reach.count; ++i) {
    const Reach::Item item = {foremost - reach.items[i].behind_m, reach.items[i].towards_m};
    if (item.behind_m <= contact_gap_m + approach_m_max) reach.items[kept++] = item;
  }
  reach.count = kept;
  return reach;
}

// The least x > 0 at which spare - closing x - bend x^2 / 2 = 0, for spare >= 0.
double root(double spare_m, double closing_m, double bend_m) {
  WAITPOINT_FAST_CHECK(spare_m >= 0 && bend_m >= 0, "an advance begins beyond its gap");
  const double wide = std::sqrt(closing_m * closing_m + 2 * bend_m * spare_m);
  if (closing_m > 0) return 2 * spare_m / (closing_m + wide);
  return bend_m > 0 ? (wide - closing_m) / bend_m : HUGE_VAL;
}

double safe_advance(const Reach& a, const Reach& b, double spare_m, double bend_m) {
  double advance = HUGE_VAL;
  for (std::size_t i = 0; i < a.count; ++i) {
    for (std::size_t j = 0; j < b.count; ++j) {
      const double spare = spare_m + a.items[i].behind_m + b.items[j].behind_m;
      advance = std::min(advance, root(spare, a.items[i].towards_m + b.items[j].towards_m, bend_m));
    }
  }
  return advance;
}

// The rate of change of a gap of at most 1 um, in the plane or in height.
struct Closing {
  double gap_m, by_first_m, by_second_m;
  double path_m;  // of both together in a whole step

  // Below this a rate is rounding: the motion slides.
  double sliding_m() const { return 1e-12 * path_m; }
  bool out_of_slack() const { return gap_m <= least_gap_m + contact_tolerance_m; }
  bool is_contact() const { return by_first_m + by_second_m > (out_of_slack() ? -sliding_m() : sliding_m()); }

  Contact contact(const Mover& a, const Mover& b, double fraction) const {
    Contact contact = {fraction, by_first_m > 0.5 * sliding_m(), by_second_m > 0.5 * sliding_m()};
    // With the slack used up, sliding is refused too, to the side that slides.
    if (!contact.first_closes && !contact.second_closes) {
      contact.first_closes = a.moves() && by_first_m >= by_second_m;
      contact.second_closes = b.moves() && by_second_m >= by_first_m;
      if (!contact.first_closes && !contact.second_closes) contact.first_closes = contact.second_closes = true;
    }
    return contact;
  }
};

// The first contact between the fractions `from` and `to`.
std::optional<Contact> first_contact_with_surface(const Mover& body, const Triangle& surface, double from, double to) {
  WAITPOINT_FAST_CHECK(0 <= from && from <= to && to <= 1, "an interval of a step is not within it");
  const double climb_m = body.climb_m(), up_m = std::max(from * climb_m, to * climb_m),
               down_m = std::min(from * climb_m, to * climb_m);
  std::vector<Outline> pieces;
  cover(surface, body.heights().low_m + down_m, body.heights().high_m + up_m, pieces);
  std::optional<Contact> first;
  for (const Outline& piece : pieces) {
    const std::optional<Contact> contact = first_contact(body, Mover(piece), from);
    if (contact && contact->fraction < to && (!first || contact->fraction < first->fraction)) first = contact;
  }
  if (!first || up_m - down_m <= least_gap_m) return first;
  const double middle = 0.5 * (from + to);
  if (const auto contact = first_contact_with_surface(body, surface, from, middle)) return contact;
  return first_contact_with_surface(body, surface, middle, to);
}

}  // namespace

// A disc is invariant under rotation, so only its centre counts.
double reach_m(const Shape& shape) {
  const double core = shape.kind == Shape::Kind::cylinder ? 0 : 0.5 * exact::hypot(shape.length_m, shape.width_m);
  return length(shape.pose.position()) + core;
}

Mover::Mover(const Shape& shape, const Outline& start, const Arc& arc, double height_m)
    : shape_(&shape), start_(start), heights_{shape.z_low_m + height_m, shape.z_high_m + height_m}, arc_(arc) {
  path_m_ = world::path_m(arc, reach_m(shape));
  bend_m_ = std::fabs(arc.turn_rad) * path_m_;
}

Outline Mover::at(double fraction) const {
  WAITPOINT_FAST_CHECK(0 <= fraction && fraction <= 1, "a body's outline is asked for outside of its step");
  return fraction == 0 || !moves() ? start_ : outline_of(*shape_, arc_.at(fraction));
}

PointVelocities Mover::velocities_at(double fraction) const {
  const Pose body = arc_.at(fraction);
  const auto [s, c] = exact::sincos(body.heading);
  Point of_origin = {arc_.distance_m * c, arc_.distance_m * s};
  if (arc_.side_m != 0) of_origin = of_origin + arc_.side_m * Point{-s, c};
  return {body.position(), of_origin, arc_.turn_rad};
}

std::optional<Contact> first_contact(const Mover& a, const Mover& b, double from) {
  WAITPOINT_CHECK(a.surface() == nullptr, "the first of two movers is a triangle of a mesh");
  WAITPOINT_CHECK(0 <= from && from <= 1, "a contact is searched for outside of its step");
  if (b.surface() != nullptr) return first_contact_with_surface(a, *b.surface(), from, 1);
  const VerticalGap vertical(a.heights(), a.climb_m(), b.heights(), b.climb_m());
  const double path_m = a.path_m() + b.path_m(), bend_m = a.bend_m() + b.bend_m();
  if (!vertical.changes() && (path_m == 0 || vertical.at(from) >= 0)) return std::nullopt;
  const double approach_m_max = path_m + 0.5 * bend_m;
  const double climb_m = std::fabs(a.climb_m()) + std::fabs(b.climb_m());
  double fraction = from;
  for (int round = 0; fraction < 1; ++round) {
    if (round > rounds_max) return Contact{fraction, a.moves(), b.moves()};
    const double over_m = vertical.at(fraction);
    if (over_m > contact_gap_m + contact_tolerance_m) {
      fraction += vertical.time_to(contact_gap_m, fraction);
      continue;
    }
    const Outline outline_a = a.at(fraction), outline_b = b.at(fraction);
    const auto [gap_m, normal] = separation(outline_a, outline_b);
    if (gap_m - path_m * (1 - fraction) > contact_gap_m) return std::nullopt;
    const Reach reach_a = reach_along(a, outline_a, fraction, normal, approach_m_max);
    const Reach reach_b = reach_along(b, outline_b, fraction, {-normal.x, -normal.y}, approach_m_max);
    double advance = 0;
    if (gap_m > contact_gap_m + contact_tolerance_m) {
      const double spare_m = gap_m - contact_gap_m;
      advance = std::max(spare_m / path_m, safe_advance(reach_a, reach_b, spare_m, bend_m));
    } else {
      const Closing planar = {gap_m, reach_a.closing_m(), reach_b.closing_m(), path_m};
      const Closing upwards = {over_m, vertical.first_closes_m(fraction), vertical.second_closes_m(fraction), climb_m};
      // Without climbing, bodies apart in height have been excluded already.
      const bool held_in_plane = !planar.is_contact() && (gap_m > 0 || !vertical.changes());
      const bool held_in_height = over_m > 0 && !upwards.is_contact();
      const bool by_height = vertical.changes() && over_m > gap_m;
      if (!held_in_plane && !held_in_height) return (by_height ? upwards : planar).contact(a, b, fraction);
      if (held_in_plane)
        advance = safe_advance(reach_a, reach_b, planar.out_of_slack() ? 0 : gap_m - least_gap_m, bend_m);
      if (held_in_height) advance = std::max(advance, vertical.time_to(std::min(least_gap_m, over_m), fraction));
    }
    WAITPOINT_FAST_CHECK(advance >= 0, "an advance of a motion is negative or NaN");
    fraction += advance;
  }
  return std::nullopt;
}

}  // namespace waitpoint::world
