// SPDX-License-Identifier: BSD-3-Clause
#include "world/motion/meetings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace waitpoint::world {
namespace {

// Nearer pairs go through first_contact(); beyond this gap it finds no contact.
constexpr double sure_gap_m = 2 * contact_gap_m;
constexpr double unknown = -std::numeric_limits<double>::infinity();

// A fast lower bound of the gap: that of the circumscribed discs, less the rounding of sums and roots.
double gap_at_least_m(const Outline& a, const Outline& b) {
  const auto around_m = [](const Outline& o) {
    return o.radius_m + std::sqrt(o.half_length_m * o.half_length_m + o.half_width_m * o.half_width_m);
  };
  const Point between = b.centre - a.centre;
  constexpr double rounding = 1e-12;
  return std::sqrt(dot(between, between)) * (1 - rounding) - (around_m(a) + around_m(b)) * (1 + rounding);
}

// The skin suffices for few steps at least, and for up to many if it need not exceed the mean width of the bodies.
constexpr double few_steps = 4, many_steps = 100;

}  // namespace

Meetings::Meetings(const MeetingPlace& place, std::span<const Shape> bodies)
    : place_(place), solids_(bodies), bodies_(bodies.size()), in_loop_(bodies.size(), none) {}

void Meetings::step(std::span<const Motion> motions) {
  WAITPOINT_CHECK(motions.size() == bodies_.size(), "a step has not one motion per body");
  for (const std::uint32_t body : entered_) in_loop_[body] = none;
  entered_.clear();
  contacts_.clear();
  double path_max_m = 0;
  bool any_moves = false;
  for (const Motion& motion : motions) {
    WAITPOINT_FAST_CHECK(motion.path_m >= 0 && std::isfinite(motion.path_m), "a body's path is negative or not finite");
    path_max_m = std::max(path_max_m, motion.path_m);
    any_moves = any_moves || motion.moves;
  }
  if (!any_moves) return;
  if (!listed_ || skin_used_m_ + 2 * path_max_m > skin_m_) list(path_max_m);
  WAITPOINT_CHECK(skin_used_m_ + 2 * path_max_m <= skin_m_, "new lists of neighbours do not last for a step");
  skin_used_m_ += 2 * path_max_m;
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].way_m += motions[i].path_m;
    if (motions[i].moves && bodies_[i].way_m > bodies_[i].reserve_m) meet_obstacles(i, motions[i]);
  }
  for (Pair& pair : pairs_)
    if (bodies_[pair.body].way_m + bodies_[pair.other].way_m > pair.reserve_m) meet(pair, motions);
  contacts_.run();
}

void Meetings::list(double path_max_m) {
  double width_m = 0;
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    const Bounds b = bounds_of(place_.outline(i));
    width_m += 0.5 * ((b.high.x - b.low.x) + (b.high.y - b.low.y)) / static_cast<double>(bodies_.size());
    solids_.place(i, place_.outline(i));
  }
  skin_m_ = 2 * std::max(few_steps * path_max_m, std::min(many_steps * path_max_m, width_m));
  skin_used_m_ = 0;
  obstacles_.clear();
  pairs_.clear();
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    const Bounds bounds = bounds_of(place_.outline(i)).grown(sure_gap_m);
    Body& body = bodies_[i];
    body = {0, unknown, static_cast<std::uint32_t>(obstacles_.size()), 0};
    place_.near(i, bounds.grown(0.5 * skin_m_), near_);
    for (const std::uint32_t obstacle : near_) obstacles_.push_back({obstacle, unknown});
    body.last_obstacle = static_cast<std::uint32_t>(obstacles_.size());
    if (bodies_.size() == 1) break;
    solids_.near(bounds.grown(skin_m_), near_);
    for (const std::uint32_t other : near_) {
      WAITPOINT_FAST_CHECK(other < bodies_.size(), "a body's neighbour does not exist");
      if (other > i) pairs_.push_back({i, other, unknown});
    }
  }
  listed_ = true;
}

std::uint32_t Meetings::in_loop(std::uint32_t body) {
  if (in_loop_[body] == none) {
    in_loop_[body] = contacts_.bodies();
    contacts_.add_body(place_.mover(body));
    entered_.push_back(body);
  }
  return in_loop_[body];
}

void Meetings::meet_obstacles(std::uint32_t number, const Motion& motion) {
  Body& body = bodies_[number];
  WAITPOINT_FAST_CHECK(body.first_obstacle <= body.last_obstacle && body.last_obstacle <= obstacles_.size(),
                       "a body's obstacles are not within the list");
  body.reserve_m = std::numeric_limits<double>::infinity();
  for (std::uint32_t at = body.first_obstacle; at < body.last_obstacle; ++at) {
    Obstacle& obstacle = obstacles_[at];
    if (body.way_m > obstacle.reserve_m) {
      obstacle.reserve_m = body.way_m - motion.path_m + place_.gap_m(number, obstacle.number) - sure_gap_m;
      if (body.way_m > obstacle.reserve_m) contacts_.add_obstacle(in_loop(number), place_.obstacle(obstacle.number));
    }
    body.reserve_m = std::min(body.reserve_m, obstacle.reserve_m);
  }
}

void Meetings::meet(Pair& pair, std::span<const Motion> motions) {
  const Motion &a = motions[pair.body], &b = motions[pair.other];
  if (!a.moves && !b.moves) return;
  const Outline &body_outline = place_.outline(pair.body), &other_outline = place_.outline(pair.other);
  const double way_m = bodies_[pair.body].way_m + bodies_[pair.other].way_m;
  const double before_m = way_m - a.path_m - b.path_m - sure_gap_m;
  pair.reserve_m = before_m + gap_at_least_m(body_outline, other_outline);
  // If the discs' gap lasts for this step only, the exact gap is worth computing: it lasts longer.
  if (way_m + a.path_m + b.path_m > pair.reserve_m)
    pair.reserve_m = before_m + separation(body_outline, other_outline).distance_m;
  if (way_m > pair.reserve_m) {
    const std::uint32_t body = in_loop(pair.body);
    contacts_.add_pair(body, in_loop(pair.other));
  }
}

}  // namespace waitpoint::world
