// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/shortest_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/modules/executive/drawn_map.hpp"

namespace waitpoint::executive {
namespace {

// Relaxes all edges until nothing changes: slow, and independent of the implementation under test.
std::uint32_t by_force(const FreeSpace& space, CellIndex start, CellIndex goal) {
  const std::int32_t width = space.map().width(), height = space.map().height();
  std::vector<std::uint32_t> cost(static_cast<std::size_t>(width * height), ShortestPath::unreachable);
  const auto at = [&](CellIndex c) -> std::uint32_t& {
    return cost[static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c.x)];
  };
  at(start) = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::int32_t i = 0; i < width * height; ++i) {
      const CellIndex c = {i % width, i / width};
      if (at(c) == ShortestPath::unreachable) continue;
      for (std::int32_t k = 0; k < 9; ++k) {
        const CellIndex next = {c.x + k % 3 - 1, c.y + k / 3 - 1};
        if (k == 4 || !space.passable(next)) continue;
        const std::uint32_t step = k % 2 == 0 ? ShortestPath::diagonal_step : ShortestPath::straight_step;
        const std::uint32_t through = at(c) + step * space.cell_cost(next);
        if (through < at(next)) at(next) = through, changed = true;
      }
    }
  }
  return at(goal);
}

std::uint32_t cost_of(const FreeSpace& space, const std::vector<CellIndex>& path) {
  std::uint32_t sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool diagonal = path[i].x != path[i - 1].x && path[i].y != path[i - 1].y;
    sum += (diagonal ? ShortestPath::diagonal_step : ShortestPath::straight_step) * space.cell_cost(path[i]);
  }
  return sum;
}

TEST(ShortestPath, EqualsBruteForceOnRandomMaps) {
  ShortestPath search;
  std::vector<CellIndex> path;
  int found = 0, none = 0;
  for (std::uint64_t map = 0; map < 150; ++map) {
    const RandomStream random(map, "test", "ends");
    const auto width = static_cast<std::int32_t>(5 + random.below(26, 0)),
               height = static_cast<std::int32_t>(5 + random.below(26, 1));
    PlanningParameters parameters;
    parameters.robot_radius_m = 0.01 + 0.05 * random.uniform(2);
    parameters.clearance_m = 0.02;
    parameters.preferred_clearance_m = 0.15;
    const FreeSpace space(test::random_map(width, height, 0.3 * random.uniform(3), map), parameters);
    const auto cell = [&](std::uint64_t k) {
      return CellIndex{static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(width), k)),
                       static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(height), k + 1))};
    };
    for (std::uint64_t k = 10; k < 60; k += 4) {
      const CellIndex start = cell(k), goal = cell(k + 2);
      if (!space.passable(start) || !space.passable(goal)) continue;
      const std::uint32_t cost = search.find(space, start, goal, path);
      ASSERT_EQ(cost, by_force(space, start, goal)) << "map " << map;
      if (cost == ShortestPath::unreachable) {
        ++none;
        ASSERT_TRUE(path.empty());
        continue;
      }
      ++found;
      ASSERT_EQ(path.front(), start);
      ASSERT_EQ(path.back(), goal);
      ASSERT_EQ(cost_of(space, path), cost);
      for (std::size_t i = 0; i < path.size(); ++i) {
        ASSERT_TRUE(space.passable(path[i]));
        if (i > 0) {
          ASSERT_LE(std::max(std::abs(path[i].x - path[i - 1].x), std::abs(path[i].y - path[i - 1].y)), 1);
        }
      }
    }
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(none, 10);
}

// Then the search is guided by the costs on the map without what has been seen.
TEST(ShortestPath, EqualsBruteForceAmongWhatHasBeenSeen) {
  PlanningParameters parameters;
  parameters.robot_radius_m = 0.05;
  parameters.clearance_m = 0.02;
  parameters.preferred_clearance_m = 0.3;
  parameters.explained_m = 0.05;
  ShortestPath search;
  std::vector<CellIndex> path;
  int found = 0;
  for (const bool is_known : {false, true}) {
    FreeSpace space(std::make_shared<const KnownSpace>(test::random_map(40, 40, 0.02, 4), is_known), parameters);
    SeenMap seen(space.map(), 5);
    const RandomStream random(1, "test", "scan");
    for (std::uint64_t scan = 0; scan < 20; ++scan) {
      posters::LaserReading reading;
      reading.first_angle_rad = -exact::pi;
      reading.angle_step_rad = exact::pi / 90;
      reading.range_max_m = 5;
      for (std::uint64_t i = 0; i < 180; ++i)
        reading.range_m.push_back(static_cast<float>(0.3 + 1.5 * random.uniform(180 * scan / 4 + i / 6)));
      seen.add({1, 1, 0}, reading);
      space.see(seen);
      for (const CellIndex goal : {CellIndex{3, 3}, CellIndex{36, 30}}) {
        const CellIndex start = {20, 20};
        if (!space.passable(start) || !space.passable(goal)) continue;
        const std::uint32_t cost = search.find(space, start, goal, path);
        ASSERT_EQ(cost, by_force(space, start, goal)) << scan;
        if (cost == ShortestPath::unreachable) continue;
        ++found;
        ASSERT_EQ(cost_of(space, path), cost);
      }
    }
  }
  EXPECT_GT(found, 20);
}

TEST(ShortestPath, SameSearchTwiceGivesTheSameWay) {
  PlanningParameters parameters;
  parameters.robot_radius_m = 0.05;
  const FreeSpace space(test::random_map(60, 60, 0.02, 4), parameters);
  ShortestPath fresh, used;
  std::vector<CellIndex> first, second;
  ASSERT_TRUE(space.passable({3, 3}) && space.passable({50, 41}));
  used.find(space, {50, 41}, {3, 3}, second);
  fresh.find(space, {3, 3}, {50, 41}, first);
  used.find(space, {3, 3}, {50, 41}, second);
  EXPECT_EQ(first, second);
}

TEST(ShortestPath, PrefersClearanceOverASlightlyShorterWay) {
  std::vector<std::string> rows(40, std::string(100, ' '));
  rows.front() = rows.back() = std::string(100, '#');
  const FreeSpace space(test::drawn_map(rows, 0.05), {});
  ShortestPath search;
  std::vector<CellIndex> path;
  search.find(space, {10, 8}, {90, 8}, path);
  std::int32_t highest = 0;
  for (const CellIndex c : path) highest = std::max(highest, c.y);
  EXPECT_GT(highest, 12);  // moves away from the wall in between
}

}  // namespace
}  // namespace waitpoint::executive
