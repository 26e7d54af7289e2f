// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/known_map.hpp"

#include <algorithm>
#include <cmath>

#include "world/formats/drawn_cells.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::run {
namespace {

/// The extent of a floor.
class Extent {
 public:
  void hold(const world::Bounds& bounds) {
    bounds_ = empty_
                  ? bounds
                  : world::Bounds{{std::min(bounds_.low.x, bounds.low.x), std::min(bounds_.low.y, bounds.low.y)},
                                  {std::max(bounds_.high.x, bounds.high.x), std::max(bounds_.high.y, bounds.high.y)}};
    empty_ = false;
  }
  void hold(Point point, double margin_m) {
    hold({{point.x - margin_m, point.y - margin_m}, {point.x + margin_m, point.y + margin_m}});
  }
  world::Bounds bounds() const { return empty_ ? world::Bounds{{0, 0}, {1, 1}} : bounds_; }

 private:
  world::Bounds bounds_;
  bool empty_ = true;
};

void hold(Extent& extent, const std::vector<world::MeshObstacle>& meshes) {
  for (const world::MeshObstacle& obstacle : meshes)
    for (const world::SpaceVector& corner : obstacle.mesh->corners) extent.hold({corner.x, corner.y}, 0);
}

OccupancyGrid grid_around(const scenario::Scenario& scenario, const world::WorldFile* map) {
  Extent extent;
  for (const world::Obstacle& obstacle : scenario.shapes) extent.hold(bounds_of(outline_of(obstacle.shape)));
  hold(extent, scenario.meshes);
  if (map != nullptr) {
    hold(extent, map->meshes);
    for (const world::Obstacle& obstacle : map->obstacles) extent.hold(bounds_of(outline_of(obstacle.shape)));
    for (const scenario::RobotScenario& robot : scenario.robots) {
      extent.hold(robot.body.start.position(), drawn_margin_m);
      for (const scenario::Goal& goal : robot.goals) extent.hold(goal.position, drawn_margin_m);
    }
  }
  const auto [low, high] = extent.bounds();
  // The map is a grid: the extent of the shapes must fit into one.
  const double floor_m2_max = static_cast<double>(OccupancyGrid::cells_max) * drawn_resolution_m * drawn_resolution_m;
  if (!((high.x - low.x + 1) * (high.y - low.y + 1) < floor_m2_max))
    throw BadInput(map != nullptr ? scenario.map->file.string() : scenario.file,
                   "the shapes span more than " + std::to_string(static_cast<long>(floor_m2_max)) + " m2");
  const auto cells = [](double length_m) {
    return std::max(1, static_cast<int>(std::ceil(length_m / drawn_resolution_m - 1e-9)));
  };
  return OccupancyGrid(cells(high.x - low.x), cells(high.y - low.y), drawn_resolution_m, {low.x, low.y, 0}, Cell::free);
}

}  // namespace

OccupancyGrid known_map(const scenario::Scenario& scenario, const world::WorldFile* map,
                        const scenario::RobotScenario& robot) {
  const bool has_cells = map != nullptr && map->grid;
  OccupancyGrid grid = has_cells ? *map->grid : grid_around(scenario, map);
  const world::Shape body = raised(robot.body.shape, robot.body.start_height_m);
  std::vector<world::Shape> known;
  const auto add = [&](const std::vector<world::Obstacle>& obstacles) {
    for (const world::Obstacle& obstacle : obstacles)
      if (obstacle.known && heights_overlap(body, obstacle.shape)) known.push_back(obstacle.shape);
  };
  add(scenario.shapes);
  if (map != nullptr && !has_cells) add(map->obstacles);
  world::draw(known, grid);
  const auto draw = [&](const std::vector<world::MeshObstacle>& meshes) {
    for (const world::MeshObstacle& obstacle : meshes)
      if (obstacle.known) world::draw(*obstacle.mesh, body.z_low_m, body.z_high_m, grid);
  };
  draw(scenario.meshes);
  if (map != nullptr) draw(map->meshes);
  return grid;
}

}  // namespace waitpoint::run
