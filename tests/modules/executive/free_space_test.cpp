// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/free_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/modules/executive/drawn_map.hpp"

namespace waitpoint::executive {
namespace {

OccupancyGrid box(std::int32_t width, std::int32_t height, double resolution_m) {
  return OccupancyGrid(width, height, resolution_m, {}, Cell::free);
}

void fill(OccupancyGrid& grid, CellIndex low, CellIndex high, Cell state) {
  for (std::int32_t y = low.y; y <= high.y; ++y)
    for (std::int32_t x = low.x; x <= high.x; ++x) grid[{x, y}] = state;
}

// Every point with the full radius and clearance is in a passable cell; no passable centre is nearer than `hard`.
TEST(FreeSpace, InflationIsExactToHalfACellsDiagonal) {
  PlanningParameters parameters;
  const double full = parameters.robot_radius_m + parameters.clearance_m;
  for (const double resolution : {0.02, 0.03, 0.05, 0.06}) {
    OccupancyGrid grid = box(40, 40, resolution);
    const RandomStream random(3, "test", "cells");
    for (std::uint64_t k = 0; k < 6; ++k)
      grid[{static_cast<int>(random.below(40, k, 0)), static_cast<int>(random.below(40, k, 1))}] = Cell::occupied;
    const FreeSpace space(grid, parameters);
    const auto distance = [&](Point p) {
      double best = 100;
      for (std::int32_t row = 0; row < 40; ++row)
        for (std::int32_t column = 0; column < 40; ++column) {
          if (grid[{column, row}] != Cell::occupied) continue;
          const double dx = std::max({column * resolution - p.x, p.x - (column + 1) * resolution, 0.0});
          const double dy = std::max({row * resolution - p.y, p.y - (row + 1) * resolution, 0.0});
          best = std::min(best, std::sqrt(dx * dx + dy * dy));
        }
      return best;
    };
    for (std::uint64_t k = 0; k < 2000; ++k) {
      const Point p = {40 * resolution * random.uniform(k, 1), 40 * resolution * random.uniform(k, 2)};
      const CellIndex c = *grid.cell_at(p);
      if (distance(p) >= full) {
        ASSERT_TRUE(space.passable(c)) << resolution;
      }
      if (space.passable(c)) {
        ASSERT_GE(distance(grid.centre(c)), full - resolution / std::sqrt(2.0) - 1e-9);
      }
      ASSERT_NEAR(space.clearance_m(c), std::min(distance(grid.centre(c)), 127.5 * resolution), 1e-9);
    }
  }
}

TEST(FreeSpace, UnknownCellsAreClosedWithoutClearance) {
  OccupancyGrid grid = box(40, 10, 0.05);
  fill(grid, {20, 0}, {20, 9}, Cell::unknown);
  const FreeSpace space(grid, {});
  EXPECT_FALSE(space.passable({20, 5}));
  EXPECT_TRUE(space.passable({19, 5}));
}

TEST(FreeSpace, MarkedEchoesCloseTheWayUntilForgotten) {
  OccupancyGrid grid = box(60, 60, 0.05);
  FreeSpace space(grid, {});
  const std::vector<Point> echo = {{1.5, 1.5}};
  space.mark(echo);
  EXPECT_FALSE(space.passable({30, 30}));
  EXPECT_FALSE(space.passable({34, 30}));
  EXPECT_TRUE(space.passable({40, 30}));
  // Equals the distance transform with an obstacle in that cell.
  fill(grid, {30, 30}, {30, 30}, Cell::occupied);
  const FreeSpace drawn(grid, {});
  for (std::int32_t i = 0; i < 3600; ++i) {
    const CellIndex c = {i % 60, i / 60};
    EXPECT_EQ(space.passable(c), drawn.passable(c));
    EXPECT_EQ(space.cell_cost(c), drawn.cell_cost(c));
  }
  space.forget();
  EXPECT_TRUE(space.passable({30, 30}));
}

TEST(FreeSpace, EchoesOfMappedObstaclesAreNotMarked) {
  OccupancyGrid grid = box(60, 60, 0.05);
  fill(grid, {0, 0}, {59, 0}, Cell::occupied);
  FreeSpace space(grid, {});
  const std::vector<Point> echoes = {{1.5, 0.2}, {1.0, 0.12}};
  space.mark(echoes);
  EXPECT_FALSE(space.marked());
}

TEST(FreeSpace, ClearLineLooksAtEveryCellItTouches) {
  const RandomStream random(5, "test", "lines");
  const OccupancyGrid grid = test::random_map(30, 30, 0.03, 8);
  PlanningParameters points_only;
  points_only.robot_radius_m = 0.001;
  points_only.clearance_m = 0;
  const FreeSpace space(grid, points_only);
  int clear = 0;
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const auto cell = [&](std::uint64_t i) {
      return CellIndex{static_cast<std::int32_t>(random.below(30, k, i)),
                       static_cast<std::int32_t>(random.below(30, k, i + 1))};
    };
    const CellIndex a = cell(0), b = cell(2);
    bool expected = true;  // by fine sampling, off the boundaries
    for (int i = 0; i <= 5000; ++i) {
      const double t = i / 5000.0;
      const double x = a.x + 0.5 + t * (b.x - a.x), y = a.y + 0.5 + t * (b.y - a.y);
      const CellIndex c = {static_cast<std::int32_t>(std::floor(x)), static_cast<std::int32_t>(std::floor(y))};
      const bool on_boundary = std::fabs(x - std::nearbyint(x)) < 1e-9 || std::fabs(y - std::nearbyint(y)) < 1e-9;
      if (!on_boundary && grid[c] == Cell::occupied) expected = false;
    }
    if (!expected) {
      ASSERT_FALSE(space.clear_line(a, b, 1));
    }
    if (space.clear_line(a, b, 1)) {
      ++clear;
    } else {
      ASSERT_FALSE(space.clear_line(b, a, 1));
    }
  }
  EXPECT_GT(clear, 300);
}

}  // namespace
}  // namespace waitpoint::executive
