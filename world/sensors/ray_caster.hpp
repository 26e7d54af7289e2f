// SPDX-License-Identifier: BSD-3-Clause
// What a sensor asks of an engine: how far a ray goes.
#pragma once

#include "world/planar/ray.hpp"

namespace waitpoint::world {

class RayCaster {
 public:
  /// The distance to what the ray hits first, as the sensor's body sees the world; the sensor's greatest range where
  /// nothing is nearer.
  virtual double distance_m(const Ray& ray) const = 0;

 protected:
  ~RayCaster() = default;
};

}  // namespace waitpoint::world
