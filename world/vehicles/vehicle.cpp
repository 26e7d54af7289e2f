// SPDX-License-Identifier: BSD-3-Clause
#include "world/vehicles/vehicle.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace waitpoint::world {
namespace {

// A body that moves less than this fraction of the tried motion is held.
constexpr double way_least = 0.1;

bool held(const Arc& tried, const Arc& came) {
  const double length_m2 =
      tried.distance_m * tried.distance_m + tried.side_m * tried.side_m + tried.climb_m * tried.climb_m;
  if (length_m2 == 0) return tried.turn_rad * came.turn_rad < way_least * tried.turn_rad * tried.turn_rad;
  return tried.distance_m * came.distance_m + tried.side_m * came.side_m + tried.climb_m * came.climb_m <
         way_least * length_m2;
}

}  // namespace

Vehicle::Vehicle(const BodyDescription& description, std::uint64_t seed)
    : description_(&description), odometer_(description.base, seed, description.name) {
  if (description.sensors<Battery>()) battery_.emplace(*description.sensors<Battery>());
  state_.height_m = description.start_height_m;
  put(description.start);
}

void Vehicle::command(Velocity velocity, std::uint64_t steps) {
  for (const double v : {velocity.v_m_s, velocity.w_rad_s, velocity.side_m_s, velocity.climb_m_s})
    WAITPOINT_CHECK(v == v, "a velocity of NaN");
  commanded_ = velocity;
  commanded_at_ = steps;
}

Velocity Vehicle::wanted(std::uint64_t step, Duration period) const {
  const BaseDescription& base = description_->base;
  if (battery_ && battery_->empty()) return {.climb_m_s = -base.climb_max_m_s};
  const Duration silent = period * static_cast<std::int64_t>(step - 1 - commanded_at_);
  const bool heard = base.watchdog == Duration() || silent <= base.watchdog;
  return heard ? commanded_ : Velocity();
}

Arc Vehicle::latch(std::uint64_t step, Duration period) {
  const double period_s = period.seconds();
  if (guidance_) return latch_guided(period_s);
  motion_ = next_motion(description_->base, motion_, wanted(step, period), period_s);
  Arc arc = Arc::of(state_.pose, motion_.velocity, period_s);
  if (state_.height_m + arc.climb_m < 0) {  // the floor holds it
    arc.climb_m = -state_.height_m;
    motion_.velocity.climb_m_s = arc.climb_m / period_s;
  }
  state_.velocity = motion_.velocity;
  return arc;
}

// The arc to a reported pose corrects the position: its speed is none of the robot's.
Arc Vehicle::latch_guided(double period_s) {
  state_.velocity = motion_.velocity = guidance_->velocity;
  if (!guidance_->to) return Arc::of(state_.pose, guidance_->velocity, period_s);
  const Pose to = *guidance_->to;
  guidance_->to.reset();
  return Arc::between(state_.pose, to.position() - state_.pose.position(), to.heading - state_.pose.heading, 0);
}

void Vehicle::publish(std::uint64_t step, Duration period, const Arc& arc, std::optional<double> stop) {
  if (stop) state_.velocity = motion_.velocity = {};
  note_contact(stop.has_value(), arc.moves());
  go(step, period, stop ? arc.until(*stop) : arc);
}

void Vehicle::publish(std::uint64_t step, Duration period, const Arc& tried, const BodyMotion& motion) {
  const Arc arc = Arc::between(state_.pose, motion.moved, motion.turned_rad, motion.climbed_m);
  state_.velocity = motion.velocity;
  motion_.velocity = nearest_held(description_->base, motion.velocity);
  note_contact(motion.touched && held(tried, arc), tried.moves());
  go(step, period, arc);
}

void Vehicle::note_contact(bool stalled, bool tried) {
  if (stalled) {
    if (!state_.stalled) ++state_.collisions;
    state_.stalled = true;
  } else if (tried) {
    state_.stalled = false;
  }
}

void Vehicle::go(std::uint64_t step, Duration period, const Arc& arc) {
  state_.arc = arc;
  if (arc.moves()) {
    state_.pose = arc.end();
    outline_ = outline_of(description_->shape, state_.pose);
    state_.height_m += arc.climb_m;
    state_.travelled_m += arc.length_m();
  }
  odometer_.add(step, period.seconds(), as_wheels_count(description_->base, arc));
  if (battery_) battery_->draw(period * static_cast<std::int64_t>(step), period, state_.velocity, state_.stalled);
}

Battery::Reading Vehicle::battery(double elapsed_s) const {
  return battery_ ? battery_->reading() : base_battery(description_->base, elapsed_s, state_.travelled_m);
}

void Vehicle::put(const Pose& pose) {
  state_.pose = pose;
  state_.arc = {.start = pose};
  state_.velocity = motion_.velocity = {};
  state_.stalled = false;
  outline_ = outline_of(description_->shape, pose);
}

void Vehicle::guide(const std::optional<Pose>& to, const Velocity& velocity) {
  for (const double v : {velocity.v_m_s, velocity.w_rad_s, velocity.side_m_s, velocity.climb_m_s})
    WAITPOINT_CHECK(v == v, "a velocity of NaN");
  if (to)
    for (const double v : {to->x, to->y, to->heading}) WAITPOINT_CHECK(v == v, "a pose of NaN");
  guidance_ = Guidance{to, velocity};
}

}  // namespace waitpoint::world
