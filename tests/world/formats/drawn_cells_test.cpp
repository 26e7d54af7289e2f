// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/drawn_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/world/scenes.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::world {
namespace {

TEST(DrawnCells, AShapeThatEndsOnCellEdgesTakesThoseCellsAlone) {
  OccupancyGrid grid(20, 20, 0.05, {}, Cell::free);
  const Shape shape = box({0.5, 0.3, 0}, 0.2, 0.1);  // columns 8 to 11, rows 5 and 6
  draw({&shape, 1}, grid);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      EXPECT_EQ((grid[{x, y}] == Cell::occupied), (x >= 8 && x < 12 && y >= 5 && y < 7)) << x << ", " << y;
    }
  }
}

TEST(DrawnCells, ExactlyTheCellsThatAShapeReachesInto) {
  Draws draws(1);
  for (int round = 0; round < 60; ++round) {
    const Pose origin = {draws(-1, 1), draws(-1, 1), round % 2 == 0 ? 0 : draws(-3, 3)};
    OccupancyGrid grid(30, 30, 0.1, origin, Cell::free);
    Shape shape = random_shape(draws, 1, 2);
    shape.pose = compose(origin, {shape.pose.x + 1.5, shape.pose.y + 1.5, shape.pose.heading});
    draw({&shape, 1}, grid);
    const Outline outline = outline_of(shape);
    const auto inside = [&](Point p, double margin) {
      const Point q = outline.local(p);
      if (outline.polygon != nullptr) {
        return std::ranges::all_of(outline.polygon->sides(), [&](const ConvexPolygon::Side& side) {
          return dot(side.outward, q) < side.beyond_m + margin;
        });
      }
      if (!outline.is_box) return length(q) < outline.radius_m + margin;
      return std::fabs(q.x) < outline.half_length_m + margin && std::fabs(q.y) < outline.half_width_m + margin;
    };
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 30; ++x) {
        // Sampled at 21 x 21 points: any inside means occupied; none inside or near means free.
        bool touched = false, near = false;
        for (int i = 0; i <= 20; ++i) {
          for (int j = 0; j <= 20; ++j) {
            const Point p = transform(origin, {0.1 * (x + i / 20.0), 0.1 * (y + j / 20.0)});
            touched = touched || inside(p, -1e-6);
            near = near || inside(p, 0.005);
          }
        }
        if (touched) {
          EXPECT_EQ((grid[{x, y}]), Cell::occupied);
        }
        if (!near) {
          EXPECT_EQ((grid[{x, y}]), Cell::free);
        }
      }
    }
  }
}

TEST(DrawnCells, SkipShapesOutsideTheGrid) {
  OccupancyGrid grid(10, 10, 0.1, {}, Cell::unknown);
  const std::vector<Shape> shapes = {box({5, 5, 0}, 1, 1), cylinder({-3, 0.5}, 0.5), box({1.2, 0.5, 0}, 0.4, 0.1)};
  draw(shapes, grid);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) EXPECT_EQ((grid[{x, y}]), Cell::unknown);
  }
}

}  // namespace
}  // namespace waitpoint::world
