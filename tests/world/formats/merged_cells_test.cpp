// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/merged_cells.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/project.hpp"
#include "tests/world/formats/files.hpp"
#include "tests/world/scenes.hpp"
#include "world/fcl/scene.hpp"
#include "world/formats/map_server.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::world {
namespace {

// Every occupied cell is in exactly one block, every other cell in none.
void expect_exact_cover(const OccupancyGrid& grid, const std::vector<CellBlock>& blocks) {
  std::vector<int> covered(static_cast<std::size_t>(grid.width()) * static_cast<std::size_t>(grid.height()), 0);
  const auto offset = [&](int x, int y) { return static_cast<std::size_t>(y * grid.width() + x); };
  for (const CellBlock& b : blocks) {
    for (int y = b.y; y < b.y + b.height; ++y) {
      for (int x = b.x; x < b.x + b.width; ++x) {
        ASSERT_TRUE(grid.contains({x, y}));
        ++covered[offset(x, y)];
      }
    }
  }
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      ASSERT_EQ(covered[offset(x, y)], (grid[{x, y}] == Cell::occupied ? 1 : 0)) << x << ", " << y;
    }
  }
}

TEST(MergedCells, AMapOfNothingButSpecksIsRefused) {
  OccupancyGrid grid(2100, 1000, 0.05, {}, Cell::free);
  for (int y = 0; y < grid.height(); ++y)
    for (int x = y % 2; x < grid.width(); x += 2) grid[{x, y}] = Cell::occupied;
  EXPECT_TRUE(complains([&] { merged_occupied_cells(grid, "specks.yaml"); },
                        "specks.yaml: ", "at most 1048576 blocks of occupied cells"));
}

TEST(MergedCells, CoverRandomGridsExactly) {
  Draws draw(1);
  for (int round = 0; round < 200; ++round) {
    OccupancyGrid grid(1 + static_cast<int>(draw.below(40)), 1 + static_cast<int>(draw.below(40)), 0.05, {},
                       Cell::free);
    const double filled = draw(0, 1);
    for (int y = 0; y < grid.height(); ++y) {
      for (int x = 0; x < grid.width(); ++x) {
        if (draw(0, 1) < filled) grid[{x, y}] = Cell::occupied;
        if (draw(0, 1) < 0.1) grid[{x, y}] = Cell::unknown;
      }
    }
    expect_exact_cover(grid, merged_occupied_cells(grid));
  }
}

TEST(MergedCells, WallsBecomeFewBlocks) {
  OccupancyGrid grid(100, 60, 0.05, {}, Cell::free);
  for (int x = 0; x < 100; ++x) {
    for (int y = 0; y < 60; ++y) {
      if (x < 2 || x >= 98 || y < 2 || y >= 58) grid[{x, y}] = Cell::occupied;
    }
  }
  EXPECT_EQ(merged_occupied_cells(grid).size(), 4u);
}

TEST(MergedCells, ObstaclesStandWhereTheCellsAreUnderATurnedOriginToo) {
  OccupancyGrid grid(8, 6, 0.25, {3, -2, 0.7}, Cell::free);
  for (const CellIndex c : {CellIndex{1, 1}, {2, 1}, {2, 2}, {6, 4}, {0, 5}}) grid[c] = Cell::occupied;
  const std::vector<Obstacle> obstacles = obstacles_of(grid, "map", 0, 2.5);
  EXPECT_EQ(obstacles[0].name, "map 0");
  EXPECT_EQ(obstacles[0].shape.z_high_m, 2.5);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      bool solid = false;
      for (const Obstacle& o : obstacles) {
        const Outline outline = outline_of(o.shape);
        const Point p = outline.local(grid.centre({x, y}));
        solid = solid || (std::abs(p.x) < outline.half_length_m && std::abs(p.y) < outline.half_width_m);
      }
      EXPECT_EQ(solid, (grid[{x, y}] == Cell::occupied)) << x << ", " << y;
    }
  }
}

TEST(MergedCells, CoverRealMapsExactlyAndInFewBlocks) {
  const auto data = test::data_folder();
  if (!data) GTEST_SKIP() << "no real maps here: neither $WAITPOINT_DATA nor ../shared/data";
  for (const char* name : {"depot", "tb3_sandbox", "warehouse"}) {
    const OccupancyGrid grid = read_map_server_map(*data + "/maps/" + name + ".yaml");
    const std::vector<CellBlock> blocks = merged_occupied_cells(grid);
    expect_exact_cover(grid, blocks);
    std::size_t occupied = 0;
    for (int y = 0; y < grid.height(); ++y) {
      for (int x = 0; x < grid.width(); ++x) occupied += grid[{x, y}] == Cell::occupied ? 1 : 0;
    }
    EXPECT_LT(blocks.size(), occupied / 2) << name;
    RecordProperty(std::string(name) + "_cells", static_cast<int>(occupied));
    RecordProperty(std::string(name) + "_blocks", static_cast<int>(blocks.size()));
  }
}

}  // namespace
}  // namespace waitpoint::world
