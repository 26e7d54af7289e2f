// SPDX-License-Identifier: BSD-3-Clause
// The one definition of the hit of a ray and an outline. Faster searches only select the outlines to test, so all
// engines agree to the last bit, grazing rays included.
#pragma once

#include <limits>

#include "world/planar/outline.hpp"

namespace waitpoint::world {

struct Ray {
  Point origin;
  Point direction;  ///< unit vector, up to rounding
};

inline constexpr double no_hit = std::numeric_limits<double>::infinity();

/// Boxes that share an edge (merged cells of a map) round it differently. Each is enlarged by this seal, in metres, so
/// that no ray passes between them; a range is shorter by the seal over the cosine of its incidence.
inline constexpr double seal_m = 1e-12;

/// The distance in metres along the ray to the outline: 0 if the ray starts inside, `no_hit` if it misses. The outline
/// must not be a triangle.
double hit_distance(const Outline& outline, const Ray& ray);

}  // namespace waitpoint::world
