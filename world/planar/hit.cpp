// SPDX-License-Identifier: BSD-3-Clause
#include "world/planar/ray.hpp"

#include "world/planar/hit.hpp"

namespace waitpoint::world {

double hit_distance(const Outline& outline, const Ray& ray) { return hit(outline, ray); }

}  // namespace waitpoint::world
