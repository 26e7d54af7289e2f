// SPDX-License-Identifier: BSD-3-Clause
// Crosstalk of two sonars that fire at the same time: sound that leaves in the cone of the emitter, is reflected once,
// and arrives in the cone of the listener, which takes half the path for its range.
//
//   wall            as from the emitter's mirror image behind it, if the point of reflection lies on the wall
//   cylinder        at the point where its normal bisects the angle between the two: exact at equal distances
//   concave corner  reflects sound back to the emitter, and to a listener beside it
//
// Two transducers on a convex body face away from each other by the angle between them: beyond the sum of their half
// cones no single reflection leads from one to the other. That is why a ring fires in banks.
#pragma once

#include <vector>

#include "world/sensors/sonar.hpp"

namespace waitpoint::world {

/// A possible cross echo: heard if both legs of its path are free.
struct CrossEcho {
  double distance_m = 0;  ///< the listener's reading: half the path
  Point at;               ///< the point of reflection
};

/// True if any single reflection could lead from one to the other, by the angle between them.
bool may_hear(const SonarCone& listener, const SonarCone& emitter);

/// Appends the possible cross echoes of an outline, of a corner, from `emitter` to `listener`.
void add_cross_echoes(const SonarCone& emitter, const SonarCone& listener, const Outline& outline,
                      std::vector<CrossEcho>& echoes);
void add_cross_echoes(const SonarCone& emitter, const SonarCone& listener, const ConcaveCorner& corner,
                      std::vector<CrossEcho>& echoes);

}  // namespace waitpoint::world
