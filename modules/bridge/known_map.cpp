// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/known_map.hpp"

#include <algorithm>
#include <cmath>

#include "world/formats/drawn_cells.hpp"

namespace waitpoint::bridge {
namespace {

OccupancyGrid grid_around(const Scenario& scenario) {
  double low_x = 0, low_y = 0, high_x = 1, high_y = 1;
  bool first = true;
  for (const world::Obstacle& obstacle : scenario.shapes) {
    const Pose& at = obstacle.shape.pose;
    const double radius = obstacle.shape.radius_m;
    const auto [s, c] = exact::sincos(at.heading);
    const bool box = obstacle.shape.kind == world::Shape::Kind::box;
    const double half_x =
        box ? 0.5 * (std::fabs(c) * obstacle.shape.length_m + std::fabs(s) * obstacle.shape.width_m) : radius;
    const double half_y =
        box ? 0.5 * (std::fabs(s) * obstacle.shape.length_m + std::fabs(c) * obstacle.shape.width_m) : radius;
    low_x = first ? at.x - half_x : std::min(low_x, at.x - half_x);
    low_y = first ? at.y - half_y : std::min(low_y, at.y - half_y);
    high_x = first ? at.x + half_x : std::max(high_x, at.x + half_x);
    high_y = first ? at.y + half_y : std::max(high_y, at.y + half_y);
    first = false;
  }
  // The map is drawn in cells: the floor that shapes span must be one that can be.
  const double floor_m2_max = static_cast<double>(OccupancyGrid::cells_max) * drawn_resolution_m * drawn_resolution_m;
  if (!((high_x - low_x + 1) * (high_y - low_y + 1) < floor_m2_max))
    throw BadInput(scenario.file,
                   "the shapes span more than " + std::to_string(static_cast<long>(floor_m2_max)) + " m2");
  const auto cells = [](double length_m) {
    return std::max(1, static_cast<int>(std::ceil(length_m / drawn_resolution_m - 1e-9)));
  };
  return OccupancyGrid(cells(high_x - low_x), cells(high_y - low_y), drawn_resolution_m, {low_x, low_y, 0}, Cell::free);
}

}  // namespace

OccupancyGrid known_map(const Scenario& scenario, const OccupancyGrid* map) {
  OccupancyGrid grid = map != nullptr ? *map : grid_around(scenario);
  std::vector<world::Shape> known;
  for (const world::Obstacle& obstacle : scenario.shapes)
    if (obstacle.known) known.push_back(obstacle.shape);
  world::draw(known, grid);
  return grid;
}

}  // namespace waitpoint::bridge
