// SPDX-License-Identifier: BSD-3-Clause
// The surfaces that a map of cells shows to a laser: the sides of occupied cells towards free ones, also beyond a few
// unknown cells, as those between the two on a map of greys.
#pragma once

#include <vector>

#include "core/occupancy_grid.hpp"
#include "modules/matching/surface.hpp"

namespace waitpoint::locate {

/// One point for each such side, with its normal, in the map's frame; row by row. Where the sides within a quarter of a
/// metre are on a line, as those of the stair that a slanting wall becomes, the point and its normal are those of the
/// line.
std::vector<matching::SurfacePoint> surface_of(const OccupancyGrid& map);

}  // namespace waitpoint::locate
