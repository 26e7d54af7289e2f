// SPDX-License-Identifier: BSD-3-Clause
// A base with steered front wheels, as a car.
//
// The bicycle model: one front wheel in the middle represents both; the body's origin is above the rear axle, which
// cannot move sideways:  w = v tan(steering) / wheelbase.
#pragma once

#include "world/description.hpp"
#include "world/vehicles/base_motion.hpp"

namespace waitpoint::world {

/// The curvature of the path, in rad per metre driven, at that steering angle.
double curvature_per_m(const BaseDescription& base, double steering_rad);

/// limited() for this base: the curvature w / v is clamped to the steering's range, then v and w are scaled down alike
/// until w is within its limit. Without speed there is no turn.
Velocity limited_by_steering(const BaseDescription& base, Velocity wanted);

/// next_motion() for this base: the steering follows the wanted curvature at its rate, the speed at its acceleration. A
/// wanted turn without speed steers to the end of the range; a stop keeps the steering angle.
BaseMotion next_of_steering(const BaseDescription& base, const BaseMotion& now, Velocity wanted, double step_s);

}  // namespace waitpoint::world
