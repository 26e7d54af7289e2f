// SPDX-License-Identifier: BSD-3-Clause
// The kinds of bases: limits of speed and acceleration, and possible directions of motion.
//
//   synchro       a travel and a turn axis, each with its own limits
//   differential  two driven wheels; v_max_m_s is also the greatest speed of a wheel: |v| + |w| axle / 2 <= v_max
//   skid-steer    the same wheels, which slip sideways in turns: commands refer to the wheels, and the body turns as
//   with
//                 an axle that is effective_axle_ratio times longer (the distance of the instantaneous centres of
//                 rotation of its two sides: Mandow, Martinez, Morales, Blanco, Garcia-Cerezo, Gonzalez, IROS 2007)
//   Ackermann     a front wheel steers: w = v tan(steering) / wheelbase, the least turning radius is wheelbase /
//                 tan(steering_max); it cannot turn on the spot
//   omni          any direction in the plane: v_max_m_s and v_acceleration_m_s2 bound the length of the vector
//   aerial        an omni base in the air, which climbs and descends, too, down to the floor
//
// Components of a command that a base does not have are ignored.
#pragma once

#include "world/arc.hpp"
#include "world/description.hpp"
#include "world/vehicles/base_motion.hpp"
#include "world/world.hpp"

namespace waitpoint::world {

/// The velocity nearest to `wanted` that the base can hold: each axis clamped, then both scaled down alike (which keeps
/// the curvature, or the direction) until every wheel is within its limit.
Velocity limited(const BaseDescription& base, Velocity wanted);

/// The velocity nearest to a body's actual one, driven or pushed, that its base can hold.
Velocity nearest_held(const BaseDescription& base, Velocity moving);

/// The motion one step after `now`: towards limited(wanted), each component by at most its acceleration (or rate of
/// steering) times the step. `now` is within the limits, and so is the result.
BaseMotion next_motion(const BaseDescription& base, const BaseMotion& now, Velocity wanted, double step_s);

/// A body's motion as counted by its wheels: those of a skid-steer base turn by more than the body, and only the wheels
/// of omni bases roll sideways.
Arc as_wheels_count(const BaseDescription& base, const Arc& arc);

/// The default battery of a base: its voltage falls linearly from full to empty with the time since the start and the
/// distance driven; its power never ends.
Battery::Reading base_battery(const BaseDescription& base, double elapsed_s, double travelled_m);

}  // namespace waitpoint::world
