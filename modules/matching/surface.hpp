// SPDX-License-Identifier: BSD-3-Clause
// A scan as points of surfaces: echoes some distance apart, each with the normal of the surface that it lies on.
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "modules/posters/laser.hpp"

namespace waitpoint::matching {

struct SurfacePoint {
  Point position;
  Point normal;  ///< unit, towards the observer; zero where the neighbouring echoes show no surface
};

struct SurfaceParameters {
  double range_m_min = 0.05, range_m_max = 25;  ///< echoes outside are of the robot itself, or too sparse
  double spacing_m = 0.05;                      ///< least distance of points, except at a jump in range
  double reach_m = 0.2;                         ///< of the neighbours, at least, that show the surface
  double jump_m = 0.3;                          ///< between neighbours of one surface, at most
};

/// The points of a scan in the robot's frame, counter-clockwise.
void surface_of(const posters::Echoes& echoes, const SurfaceParameters& parameters, std::vector<SurfacePoint>& points);

}  // namespace waitpoint::matching
