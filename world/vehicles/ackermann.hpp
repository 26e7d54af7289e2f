// SPDX-License-Identifier: BSD-3-Clause
// A base that steers by its front wheels, as a car does.
//
// One front wheel stands for both, in the middle (the bicycle model); the body's origin is above the rear axle, which
// cannot move sideways:  w = v tan(steering) / wheelbase.
#pragma once

#include "world/description.hpp"
#include "world/vehicles/base_motion.hpp"

namespace waitpoint::world {

/// At that steering, the turn for each metre driven.
double curvature_per_m(const BaseDescription& base, double steering_rad);

/// As limited(): the curvature w / v is clamped to what the steering allows, then both are slowed alike until the body
/// does not turn too fast. Standing still it turns nowhere.
Velocity limited_by_steering(const BaseDescription& base, Velocity wanted);

/// As next_motion(): the steering follows the wanted curvature at its rate, the speed at its acceleration. A turn that
/// is wanted without speed steers to the end of its range; a stop leaves the wheels as they are.
BaseMotion next_of_steering(const BaseDescription& base, const BaseMotion& now, Velocity wanted, double step_s);

}  // namespace waitpoint::world
