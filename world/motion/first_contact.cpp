// SPDX-License-Identifier: BSD-3-Clause
#include "world/motion/first_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace waitpoint::world {
namespace {

constexpr double least_gap_m = 0.5 * contact_gap_m;
// Advancement gains at least contact_tolerance_m / path a round, and far more by the bound of second order; a motion
// that needs more rounds than this (none is known) is taken as touching, which is safe.
constexpr int rounds_max = 100000;

// The core points of one side as seen along the normal: how far the point reaches towards the other side, less than the
// foremost point (0 for that one), and how fast it moves that way.
struct Reach {
  struct Item {
    double behind_m = 0, towards_m = 0;
  };
  std::array<Item, 4> items;
  std::size_t count = 0;

  // The fastest approach among the points that are foremost, but for rounding.
  double closing_m() const {
    double closing = -HUGE_VAL;
    for (std::size_t i = 0; i < count; ++i) {
      if (items[i].behind_m <= contact_tolerance_m) closing = std::max(closing, items[i].towards_m);
    }
    return closing;
  }
};

Reach reach_along(const Mover& mover, const Outline& outline, double fraction, Point normal) {
  Reach reach;
  if (!mover.moves()) {
    reach.count = 1;
    return reach;
  }
  const PointVelocities velocities = mover.velocities_at(fraction);
  double foremost = -HUGE_VAL;
  for (const Point& p : core_points(outline)) {
    const double along = dot(normal, p);
    foremost = std::max(foremost, along);
    reach.items[reach.count++] = {along, dot(normal, velocities.of(p))};
  }
  for (std::size_t i = 0; i < reach.count; ++i) reach.items[i].behind_m = foremost - reach.items[i].behind_m;
  return reach;
}

// The least x > 0 at which spare - closing x - bend x^2 / 2 = 0, for spare >= 0.
double root(double spare_m, double closing_m, double bend_m) {
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

}  // namespace

Mover::Mover(const Shape& shape, const Outline& start, const Arc& arc) : shape_(&shape), start_(start), arc_(arc) {
  const double core = shape.kind == Shape::Kind::box ? 0.5 * exact::hypot(shape.length_m, shape.width_m) : 0;
  const double reach = length(shape.pose.position()) + core;
  const double distance = std::fabs(arc.distance_m), turn = std::fabs(arc.turn_rad);
  path_m_ = distance + turn * reach;
  bend_m_ = turn * (distance + turn * reach);
}

Outline Mover::at(double fraction) const {
  return fraction == 0 || !moves() ? start_ : outline_of(*shape_, arc_.at(fraction));
}

PointVelocities Mover::velocities_at(double fraction) const {
  const Pose body = arc_.at(fraction);
  const auto [s, c] = exact::sincos(body.heading);
  return {body.position(), {arc_.distance_m * c, arc_.distance_m * s}, arc_.turn_rad};
}

std::optional<Contact> first_contact(const Mover& a, const Mover& b, double from) {
  const double path_m = a.path_m() + b.path_m(), bend_m = a.bend_m() + b.bend_m();
  if (path_m == 0) return std::nullopt;
  // Below this a rate is rounding: the motion slides.
  const double sliding_m = 1e-12 * path_m;
  double fraction = from;
  for (int round = 0; fraction < 1; ++round) {
    const Outline outline_a = a.at(fraction), outline_b = b.at(fraction);
    const auto [gap_m, normal] = separation(outline_a, outline_b);
    if (gap_m - path_m * (1 - fraction) > contact_gap_m) return std::nullopt;
    const Reach reach_a = reach_along(a, outline_a, fraction, normal);
    const Reach reach_b = reach_along(b, outline_b, fraction, {-normal.x, -normal.y});
    double advance = 0;
    if (gap_m > contact_gap_m + contact_tolerance_m) {
      const double spare_m = gap_m - contact_gap_m;
      advance = std::max(spare_m / path_m, safe_advance(reach_a, reach_b, spare_m, bend_m));
    } else {
      const double closing_a = reach_a.closing_m(), closing_b = reach_b.closing_m();
      const bool out_of_slack = gap_m <= least_gap_m + contact_tolerance_m;
      if (closing_a + closing_b > (out_of_slack ? -sliding_m : sliding_m)) {
        Contact contact = {fraction, closing_a > 0.5 * sliding_m, closing_b > 0.5 * sliding_m};
        // With the slack used up, sliding is refused too, to whoever slides.
        if (!contact.first_closes && !contact.second_closes) {
          contact.first_closes = a.moves() && closing_a >= closing_b;
          contact.second_closes = b.moves() && closing_b >= closing_a;
          if (!contact.first_closes && !contact.second_closes) contact.first_closes = contact.second_closes = true;
        }
        return contact;
      }
      advance = safe_advance(reach_a, reach_b, out_of_slack ? 0 : gap_m - least_gap_m, bend_m);
    }
    if (round >= rounds_max) return Contact{fraction, a.moves(), b.moves()};
    fraction += advance;
  }
  return std::nullopt;
}

}  // namespace waitpoint::world
