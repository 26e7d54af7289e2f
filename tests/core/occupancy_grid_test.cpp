// SPDX-License-Identifier: BSD-3-Clause
#include "core/occupancy_grid.hpp"

#include <gtest/gtest.h>

namespace waitpoint {
namespace {

TEST(OccupancyGrid, CellsAndPointsFindEachOtherUnderATurnedOrigin) {
  const OccupancyGrid grid(20, 10, 0.05, {3, -1, 0.7});
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) EXPECT_EQ(grid.cell_at(grid.centre({x, y})), (CellIndex{x, y}));
  }
  EXPECT_FALSE(grid.cell_at(transform(grid.origin(), {-0.01, 0.2})));
  EXPECT_FALSE(grid.cell_at(transform(grid.origin(), {0.2, 0.51})));
  EXPECT_FALSE(grid.cell_at({1e300, 0}));
}

TEST(OccupancyGrid, StartsFilledAndKeepsWhatIsSet) {
  OccupancyGrid grid(3, 2, 1, {});
  EXPECT_EQ((grid[{2, 1}]), Cell::unknown);
  grid[{2, 1}] = Cell::free;
  EXPECT_EQ((grid[{2, 1}]), Cell::free);
  EXPECT_EQ((grid[{1, 1}]), Cell::unknown);
  EXPECT_FALSE(grid.contains({3, 0}));
  EXPECT_FALSE(grid.contains({0, -1}));
}

TEST(OccupancyGridDeathTest, ACellOutsideIsABug) {
  const OccupancyGrid grid(3, 2, 1, {});
  EXPECT_DEATH((void)(grid[{0, 2}]), "outside");
}

}  // namespace
}  // namespace waitpoint
