// SPDX-License-Identifier: BSD-3-Clause
// What a sonar hears of another one that fires at the same time: sound that leaves in the cone of one, is thrown back
// once, and arrives in the cone of the other, which takes half the path for its range.
//
//   wall            as from the emitter's mirror image behind it, if the place of the reflection lies on the wall
//   cylinder        where its normal halves the angle between the two: exact if both are as far from it
//   concave corner  sends sound back to where it came from, and to what is beside that
//
// Two transducers on a convex body face away from each other by the angle between them: beyond the sum of their half
// cones no single reflection leads from one to the other. That is why a ring fires in banks.
#pragma once

#include <vector>

#include "world/sensors/sonar.hpp"

namespace waitpoint::world {

/// Something that would let one transducer hear another if nothing stood in the way of either leg.
struct CrossEcho {
  double distance_m = 0;  ///< that the listener reads: half the path
  Point at;               ///< where the sound is thrown back
};

/// Whether anything could lead from one to the other.
bool may_hear(const SonarCone& listener, const SonarCone& emitter);

/// Append what an outline, or a corner, leads from `emitter` to `listener`.
void add_cross_echoes(const SonarCone& emitter, const SonarCone& listener, const Outline& outline,
                      std::vector<CrossEcho>& echoes);
void add_cross_echoes(const SonarCone& emitter, const SonarCone& listener, const ConcaveCorner& corner,
                      std::vector<CrossEcho>& echoes);

}  // namespace waitpoint::world
