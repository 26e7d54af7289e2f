// SPDX-License-Identifier: BSD-3-Clause
// Refinement of a pose by point-to-line matching: Gauss-Newton on the distances of a scan's points from the lines
// through the nearest points of a map, with a robust weight, and with a prior (the odometry's prediction), which
// decides where the surfaces do not: along a corridor.
//
// Source: Censi, "An ICP variant using a point-to-line metric", ICRA 2008.
#pragma once

#include <array>
#include <span>

#include "modules/matching/surface_map.hpp"
#include "modules/matching/symmetric_matrix.hpp"

namespace waitpoint::matching {

struct RefinementParameters {
  unsigned iterations = 12;
  double noise_m = 0.02;       ///< standard deviation of a distance
  double robust_m = 0.06;      ///< from here on a distance counts less
  double explained_m = 0.1;    ///< a point this near to the map is explained by it
  double same_side_cos = 0.5;  ///< of the angle between the normals of a pair, at least
};

struct Refined {
  Pose pose;
  Matrix3 information{};   ///< of the surfaces alone, without the prior
  double explained = 0;    ///< share of the scan's points that the map explains
  double fit = 0;          ///< the mean over all points of 1 / (1 + (distance / robust_m)^2); 0 where the map has none
  double deviation_m = 0;  ///< of the distances of those
  unsigned pairs = 0;
};

/// From `guess`; `prior` is the information of (x, y, heading) about it.
Refined refine(const SurfaceMap& map, std::span<const SurfacePoint> scan, const Pose& guess, const Matrix3& prior,
               const RefinementParameters& parameters);

}  // namespace waitpoint::matching
