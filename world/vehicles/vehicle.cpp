// SPDX-License-Identifier: BSD-3-Clause
#include "world/vehicles/vehicle.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace waitpoint::world {

Vehicle::Vehicle(const BodyDescription& description, std::uint64_t seed)
    : description_(&description), odometer_(description.base, seed, description.name) {
  state_.height_m = description.start_height_m;
  put(description.start);
}

void Vehicle::command(Velocity velocity, std::uint64_t steps) {
  for (const double v : {velocity.v_m_s, velocity.w_rad_s, velocity.side_m_s, velocity.climb_m_s})
    WAITPOINT_CHECK(v == v, "a velocity of NaN");
  wanted_ = velocity;
  commanded_at_ = steps;
}

Arc Vehicle::latch(std::uint64_t step, Duration period) {
  const BaseDescription& base = description_->base;
  const double period_s = period.seconds();
  const Duration silent = period * static_cast<std::int64_t>(step - 1 - commanded_at_);
  const bool heard = base.watchdog == Duration() || silent <= base.watchdog;
  const BaseMotion next = next_motion(base, {state_.velocity, steering_rad_}, heard ? wanted_ : Velocity(), period_s);
  state_.velocity = next.velocity;
  steering_rad_ = next.steering_rad;
  Arc arc = Arc::of(state_.pose, state_.velocity, period_s);
  if (state_.height_m + arc.climb_m < 0) {  // the floor holds it
    arc.climb_m = -state_.height_m;
    state_.velocity.climb_m_s = arc.climb_m / period_s;
  }
  return arc;
}

void Vehicle::publish(std::uint64_t step, Duration period, const Arc& arc, std::optional<double> stop) {
  state_.arc = stop ? arc.until(*stop) : arc;
  if (stop) {
    if (!state_.stalled) ++state_.collisions;
    state_.velocity = {};
    state_.stalled = true;
  } else if (arc.moves()) {
    state_.stalled = false;
  }
  if (arc.moves()) {
    state_.pose = state_.arc.end();
    outline_ = outline_of(description_->shape, state_.pose);
    state_.height_m += state_.arc.climb_m;
    state_.travelled_m += state_.arc.length_m();
  }
  odometer_.add(step, period.seconds(), as_wheels_count(description_->base, state_.arc));
}

void Vehicle::put(const Pose& pose) {
  state_.pose = pose;
  state_.arc = {.start = pose};
  state_.velocity = {};
  state_.stalled = false;
  outline_ = outline_of(description_->shape, pose);
}

}  // namespace waitpoint::world
