// SPDX-License-Identifier: BSD-3-Clause
// The interface of a sensor to an engine: the length of a ray.
#pragma once

#include "world/planar/ray.hpp"

namespace waitpoint::world {

class RayCaster {
 public:
  /// The distance of the ray's first hit, without the sensor's own body; the sensor's greatest range if nothing is
  /// nearer.
  virtual double distance_m(const Ray& ray) const = 0;

 protected:
  ~RayCaster() = default;
};

}  // namespace waitpoint::world
