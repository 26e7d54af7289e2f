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
  void hold(const world::Bounds& bounds) { bounds_ = bounds_ ? united(*bounds_, bounds) : bounds; }
  void hold(Point point, double margin_m) { hold(around(point, margin_m)); }
  /// A start or goal outside the present bounds lies in the open, with a margin.
  void hold_if_outside(Point point, double margin_m) {
    if (!bounds_ || !bounds_->contains(around(point, 0))) outside_.push_back(around(point, margin_m));
  }
  world::Bounds bounds() const {
    std::optional<world::Bounds> all = bounds_;
    for (const world::Bounds& each : outside_) all = all ? united(*all, each) : each;
    return all.value_or(world::Bounds{{0, 0}, {1, 1}});
  }

 private:
  static world::Bounds around(Point p, double margin_m) {
    return {{p.x - margin_m, p.y - margin_m}, {p.x + margin_m, p.y + margin_m}};
  }
  static world::Bounds united(const world::Bounds& a, const world::Bounds& b) {
    return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
            {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
  }

  std::optional<world::Bounds> bounds_;
  std::vector<world::Bounds> outside_;
};

void hold(Extent& extent, const std::vector<world::MeshObstacle>& meshes) {
  for (const world::MeshObstacle& obstacle : meshes)
    for (const world::SpaceVector& corner : obstacle.mesh->corners) extent.hold({corner.x, corner.y}, 0);
}

// The map is a grid: the extent of the shapes must fit into one.
constexpr double floor_m2_max = static_cast<double>(OccupancyGrid::cells_max) * drawn_resolution_m * drawn_resolution_m;

bool fits(const world::Bounds& bounds) {
  return (bounds.high.x - bounds.low.x + 1) * (bounds.high.y - bounds.low.y + 1) < floor_m2_max;
}

// The part of `all` within reach of the robots: an object that lies far away, by a mistake in most cases, is not
// needed.
world::Bounds near_robots(const scenario::Scenario& scenario, const world::Bounds& all) {
  Extent near;
  for (const scenario::RobotScenario& robot : scenario.robots) {
    near.hold(robot.body.start.position(), drawn_reach_m);
    for (const scenario::Goal& goal : robot.goals) near.hold(goal.position, drawn_reach_m);
  }
  const auto [low, high] = near.bounds();
  return {{std::max(all.low.x, low.x), std::max(all.low.y, low.y)},
          {std::min(all.high.x, high.x), std::min(all.high.y, high.y)}};
}

OccupancyGrid grid_around(const scenario::Scenario& scenario, const world::WorldFile* map) {
  Extent extent;
  for (const world::Obstacle& obstacle : scenario.shapes) extent.hold(bounds_of(outline_of(obstacle.shape)));
  hold(extent, scenario.meshes);
  if (map != nullptr) {
    hold(extent, map->meshes);
    for (const world::Obstacle& obstacle : map->obstacles) extent.hold(bounds_of(outline_of(obstacle.shape)));
  }
  const auto hold_place = [&](Point place) {
    if (map != nullptr)
      extent.hold(place, drawn_margin_m);
    else
      extent.hold_if_outside(place, drawn_margin_m);
  };
  for (const scenario::RobotScenario& robot : scenario.robots) {
    hold_place(robot.body.start.position());
    for (const scenario::Goal& goal : robot.goals) hold_place(goal.position);
  }
  world::Bounds bounds = extent.bounds();
  if (!fits(bounds)) bounds = near_robots(scenario, bounds);
  if (!fits(bounds))
    throw BadInput(map != nullptr ? scenario.map->file.string() : scenario.file,
                   "the shapes span more than " + std::to_string(static_cast<long>(floor_m2_max)) + " m2");
  const auto [low, high] = bounds;
  const auto cells = [](double length_m) {
    return std::max(1, static_cast<int>(std::ceil(length_m / drawn_resolution_m - 1e-9)));
  };
  return OccupancyGrid(cells(high.x - low.x), cells(high.y - low.y), drawn_resolution_m, {low.x, low.y, 0}, Cell::free);
}

}  // namespace

OccupancyGrid known_map(const scenario::Scenario& scenario, const world::WorldFile* map,
                        const scenario::RobotScenario& robot) {
  const bool is_known = map == nullptr || scenario.map->known;
  const bool has_cells = is_known && map != nullptr && map->grid;
  OccupancyGrid grid = has_cells ? *map->grid : grid_around(scenario, map);
  const world::Shape body = raised(robot.body.shape, robot.body.start_height_m);
  std::vector<world::Shape> known;
  const auto add = [&](const std::vector<world::Obstacle>& obstacles) {
    for (const world::Obstacle& obstacle : obstacles)
      if (obstacle.known && heights_overlap(body, obstacle.shape)) known.push_back(obstacle.shape);
  };
  add(scenario.shapes);
  if (map != nullptr && is_known && !has_cells) add(map->obstacles);
  world::draw(known, grid);
  const auto draw = [&](const std::vector<world::MeshObstacle>& meshes) {
    for (const world::MeshObstacle& obstacle : meshes)
      if (obstacle.known) world::draw(*obstacle.mesh, body.z_low_m, body.z_high_m, grid);
  };
  draw(scenario.meshes);
  if (map != nullptr && is_known) draw(map->meshes);
  return grid;
}

std::size_t obstacles_beyond(const OccupancyGrid& map, const scenario::Scenario& scenario,
                             const world::WorldFile* file) {
  const Point low = map.origin().position();
  const world::Bounds extent = {low,
                                {low.x + map.width() * map.resolution_m(), low.y + map.height() * map.resolution_m()}};
  const auto count = [&](const std::vector<world::Obstacle>& obstacles) {
    return static_cast<std::size_t>(std::count_if(obstacles.begin(), obstacles.end(), [&](const auto& obstacle) {
      return !extent.overlaps(bounds_of(outline_of(obstacle.shape)));
    }));
  };
  return count(scenario.shapes) + (file == nullptr ? 0 : count(file->obstacles));
}

}  // namespace waitpoint::run
