// SPDX-License-Identifier: BSD-3-Clause
// The one function that says where a ray meets an outline. Everything that finds hits faster only chooses which
// outlines to ask it about, so all ways agree to the last bit, grazing rays included.
#pragma once

#include <limits>

#include "world/planar/outline.hpp"

namespace waitpoint::world {

struct Ray {
  Point origin;
  Point direction;  ///< of length 1, but for rounding
};

inline constexpr double no_hit = std::numeric_limits<double>::infinity();

/// Boxes that share an edge (a map's cells, merged) each round it in their own way. Sealed by this much, no ray slips
/// between them; a range is shorter by this much over the cosine of its incidence.
inline constexpr double seal_m = 1e-12;

/// The distance along the ray to the outline, which is no triangle: 0 if it starts inside, `no_hit` if it passes.
double hit_distance(const Outline& outline, const Ray& ray);

}  // namespace waitpoint::world
