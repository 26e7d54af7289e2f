// SPDX-License-Identifier: BSD-3-Clause
// What a base can do with a velocity command: limits of speed and of acceleration, and which ways it can go at all.
//
//   synchro       a travel and a turn axis, each with its own limits
//   differential  two driven wheels; v_max_m_s is also the greatest speed of a wheel: |v| + |w| axle / 2 <= v_max
//   skid-steer    the same wheels, that slip sideways in turns: commands are of the wheels, and the body turns as with
//                 an axle that is effective_axle_ratio times longer (the distance of the instantaneous centres of
//                 rotation of its two sides: Mandow, Martinez, Morales, Blanco, Garcia-Cerezo, Gonzalez, IROS 2007)
//   Ackermann     a front wheel steers: w = v tan(steering) / wheelbase, the least turning radius is wheelbase /
//                 tan(steering_max); it cannot turn on the spot
//   omni          any direction in the plane: v_max_m_s and v_acceleration_m_s2 bound the length of the vector
//   aerial        an omni base in the air, which climbs and sinks too, down to the floor, which holds it
//
// What a base cannot do of a command it leaves out.
#pragma once

#include "world/arc.hpp"
#include "world/description.hpp"
#include "world/vehicles/base_motion.hpp"
#include "world/world.hpp"

namespace waitpoint::world {

/// The nearest velocity to `wanted` that the base can hold: each axis clamped, then both slowed alike (which keeps the
/// curvature, or the direction) until no wheel is too fast.
Velocity limited(const BaseDescription& base, Velocity wanted);

/// The velocity nearest to how a body moves, whatever moved it, that its base could hold.
Velocity nearest_held(const BaseDescription& base, Velocity moving);

/// The motion one step after `now`: towards limited(wanted), each component by at most its acceleration (or rate of
/// steering) times the step. `now` is within the limits, and so is the result.
BaseMotion next_motion(const BaseDescription& base, const BaseMotion& now, Velocity wanted, double step_s);

/// What the wheels make of a body's motion: of a skid-steer base they turn for more than the body does; sideways only
/// those roll that can.
Arc as_wheels_count(const BaseDescription& base, const Arc& arc);

/// The battery that the base has where no other is described: its voltage falls linearly from full to empty with the
/// time since the start and the distance driven, its power ends never.
BatteryState base_battery(const BaseDescription& base, double elapsed_s, double travelled_m);

}  // namespace waitpoint::world
