// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/robots/crowds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/floors.hpp"
#include "tests/bench/world/places.hpp"
#include "tests/runs/shipped.hpp"

namespace waitpoint::bench {
namespace {

using scenario::Scenario;

constexpr double height_m = 2;

/// The shipped office without obstacles and robots, and with the engine for many.
Scenario empty_place(const std::string& name) {
  Scenario place = runs::shipped("office.yaml");
  place.name = name;
  place.engine = world::Engine::slice;
  place.shapes.clear();
  place.shapes_written.clear();
  place.robots.clear();
  return place;
}

void add(Scenario& place, world::Shape shape) {
  shape.z_high_m = height_m;
  place.shapes.push_back({"", shape});
  place.shapes_written.emplace_back();
}

void add_robot(Scenario& place, scenario::RobotScenario robot, const Pose& start, const std::vector<Point>& goals) {
  robot.name = fmt::format("robot {}", place.robots.size());
  robot.body.name = robot.name;
  robot.body.start = start;
  const scenario::Goal like = robot.goals.front();
  robot.goals.clear();
  for (const Point goal : goals) robot.goals.push_back({goal, "", like.written});
  place.robots.push_back(std::move(robot));
}

world::Shape wall(Point low, Point high) {
  world::Shape shape;
  shape.pose = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0};
  shape.length_m = high.x - low.x;
  shape.width_m = high.y - low.y;
  return shape;
}

world::Shape pillar(Point centre) {
  world::Shape shape;
  shape.kind = world::Shape::Kind::cylinder;
  shape.pose = {centre.x, centre.y, 0};
  shape.radius_m = 0.4;
  return shape;
}

}  // namespace

Scenario office_floors(int robots) {
  const Scenario floor = runs::shipped("office-10.yaml");
  Scenario floors = side_by_side(floor, robots / static_cast<int>(floor.robots.size()));
  floors.name = fmt::format("office floors, {} robots", robots);
  floors.engine = world::Engine::slice;
  return floors;
}

// A pillar at the corner of each square of 6 m, a robot in its middle, whose goals are in the middles of its
// neighbours.
Scenario hall(int robots) {
  constexpr double square_m = 6;
  const scenario::RobotScenario type = runs::shipped("office.yaml").robots.front();
  Scenario place = empty_place(fmt::format("hall, {} robots", robots));
  const int across = static_cast<int>(std::ceil(std::sqrt(robots))), up = (robots + across - 1) / across;
  const double length_m = square_m * across, width_m = square_m * up;
  add(place, wall({-0.2, -0.2}, {length_m + 0.2, 0}));
  add(place, wall({-0.2, width_m}, {length_m + 0.2, width_m + 0.2}));
  add(place, wall({-0.2, 0}, {0, width_m}));
  add(place, wall({length_m, 0}, {length_m + 0.2, width_m}));
  for (int y = 1; y < up; ++y)
    for (int x = 1; x < across; ++x) add(place, pillar({square_m * x, square_m * y}));
  const auto middle = [&](int x, int y) {
    return Point{square_m * (std::clamp(x, 0, across - 1) + 0.5), square_m * (std::clamp(y, 0, up - 1) + 0.5)};
  };
  for (int i = 0; i < robots; ++i) {
    const int x = i % across, y = i / across;
    const Point start = middle(x, y);
    const Point aside = {0, 1.5};  // the place beside the neighbour's own
    add_robot(
        place, type, {start.x, start.y, 0},
        {middle(x + 1, y) + aside, middle(x + 1, y + 1) - aside, middle(x, y + 1) + aside, middle(x - 1, y) - aside});
  }
  return place;
}

Scenario warehouse_with(int robots) {
  constexpr std::size_t rounds_of = 3;
  const Place warehouse = bench::warehouse(static_cast<std::size_t>(robots));
  const scenario::RobotScenario type = runs::shipped("office.yaml").robots.front();
  Scenario place = empty_place(fmt::format("warehouse, {} robots", robots));
  for (const world::Shape& obstacle : warehouse.obstacles) add(place, obstacle);
  for (const Pose& start : warehouse.stations) {
    std::vector<Point> others;
    for (const Pose& other : warehouse.stations)
      if (&other != &start) others.push_back(other.position());
    const auto distance = [&](Point p) { return length(p - start.position()); };
    std::sort(others.begin(), others.end(), [&](Point a, Point b) { return distance(a) < distance(b); });
    others.resize(std::min(others.size(), rounds_of));
    others.push_back(start.position());
    add_robot(place, type, start, others);
  }
  return place;
}

}  // namespace waitpoint::bench
