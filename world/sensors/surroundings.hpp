// SPDX-License-Identifier: BSD-3-Clause
// What a sensor's model may ask of the world: its own body in its current state, and the rest as published at the step
// before.
#pragma once

#include <span>

#include "world/planar/separation.hpp"
#include "world/world.hpp"

namespace waitpoint::world {

/// The step that a body has just done: of length `length`, to `now` since the start.
struct StepDone {
  Duration now, length;
};

class Surroundings {
 public:
  virtual const BodyState& body() const = 0;
  /// The distance along the beam to the first obstacle or other body; range_max_m if nothing is nearer.
  virtual double cast(const Beam& beam, double range_max_m) const = 0;
  /// The separations of the body from everything within `reach_m` of it (and from some things beyond); until the next
  /// call.
  virtual std::span<const Separation> near(double reach_m) const = 0;

 protected:
  ~Surroundings() = default;
};

}  // namespace waitpoint::world
