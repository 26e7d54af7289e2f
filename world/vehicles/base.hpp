// SPDX-License-Identifier: BSD-3-Clause
// What a wheeled base can do with a velocity command: limits of speed and of acceleration.
//
// A synchro base has a travel and a turn axis, each with its own limits. A differential base has two driven wheels, and
// v_max_m_s is also the greatest speed of a wheel: |v| + |w| axle / 2 <= v_max.
#pragma once

#include "world/arc.hpp"
#include "world/description.hpp"

namespace waitpoint::world {

/// The nearest velocity to `wanted` that the base can hold: each axis clamped, then, for a differential base, both
/// slowed alike (which keeps the curvature) until no wheel is too fast.
Velocity limited(const BaseDescription& base, Velocity wanted);

/// The velocity one step after `now`: towards limited(wanted), each component by at most its acceleration times the
/// step. `now` is within the limits, and so is the result.
Velocity next_velocity(const BaseDescription& base, Velocity now, Velocity wanted, double step_s);

/// The battery's voltage, falling linearly from full to empty with the time since the start and the distance driven.
double battery_volts(const BaseDescription& base, double elapsed_s, double travelled_m);

}  // namespace waitpoint::world
