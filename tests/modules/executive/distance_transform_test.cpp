// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/distance_transform.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "core/random.hpp"

namespace waitpoint::executive {
namespace {

std::uint16_t by_force(const std::vector<Cell>& cells, std::int32_t width, std::int32_t x, std::int32_t y) {
  std::int32_t best = square_half_cells_max;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(cells.size()); ++i) {
    if (cells[static_cast<std::size_t>(i)] != Cell::occupied) continue;
    const std::int32_t dx = std::max(0, 2 * std::abs(i % width - x) - 1);
    const std::int32_t dy = std::max(0, 2 * std::abs(i / width - y) - 1);
    best = std::min(best, dx * dx + dy * dy);
  }
  return static_cast<std::uint16_t>(best);
}

TEST(DistanceTransform, EqualsBruteForceOnRandomMaps) {
  DistanceTransform transform;  // one for all sizes: its memory is reused
  const RandomStream random(1, "test", "cells");
  for (std::uint64_t map = 0; map < 60; ++map) {
    const auto width = static_cast<std::int32_t>(1 + random.below(40, map, 0));
    const auto height = static_cast<std::int32_t>(1 + random.below(40, map, 1));
    const double density = 0.3 * random.uniform(map, 2) * random.uniform(map, 3);
    std::vector<Cell> cells;
    for (std::int32_t i = 0; i < width * height; ++i)
      cells.push_back(random.uniform(map, 10 + static_cast<std::uint64_t>(i)) < density ? Cell::occupied : Cell::free);
    std::vector<std::uint16_t> squares(cells.size());
    transform.run(cells, width, height, squares);
    for (std::int32_t i = 0; i < width * height; ++i) {
      ASSERT_EQ(squares[static_cast<std::size_t>(i)], by_force(cells, width, i % width, i / width))
          << "map " << map << " cell " << i % width << ", " << i / width;
    }
  }
}

TEST(DistanceTransform, NextToAWallIsHalfACellAndCornersAreDiagonal) {
  std::vector<Cell> cells(9, Cell::free);
  cells[0] = Cell::occupied;
  std::vector<std::uint16_t> squares(9);
  DistanceTransform().run(cells, 3, 3, squares);
  EXPECT_EQ(squares, (std::vector<std::uint16_t>{0, 1, 9, 1, 2, 10, 9, 10, 18}));
}

TEST(DistanceTransform, FarIsCappedAndEmptyIsFar) {
  std::vector<Cell> cells(400, Cell::free);
  std::vector<std::uint16_t> squares(400);
  DistanceTransform().run(cells, 400, 1, squares);
  EXPECT_EQ(*std::min_element(squares.begin(), squares.end()), square_half_cells_max);
  cells[0] = Cell::occupied;
  DistanceTransform().run(cells, 400, 1, squares);
  EXPECT_EQ(squares[100], 199 * 199);
  EXPECT_EQ(squares[399], square_half_cells_max);
}

// Distances between neighbours about the length from which a row is divided.
TEST(DistanceTransform, EqualsBruteForceWithFarObstacles) {
  DistanceTransform transform;
  const RandomStream random(1, "test", "far cells");
  constexpr std::int32_t width = 1500, height = 2;
  for (std::uint64_t map = 0; map < 8; ++map) {
    std::vector<Cell> cells(width * height, Cell::free);
    auto x = static_cast<std::int32_t>(random.below(300, map, 0));
    for (std::uint64_t i = 1; x < width; x += 120 + static_cast<std::int32_t>(random.below(150, map, i++)))
      cells[static_cast<std::size_t>(x)] = Cell::occupied;
    std::vector<std::uint16_t> squares(cells.size());
    transform.run(cells, width, height, squares);
    for (std::int32_t i = 0; i < width * height; ++i)
      ASSERT_EQ(squares[static_cast<std::size_t>(i)], by_force(cells, width, i % width, i / width))
          << "map " << map << " cell " << i % width << ", " << i / width;
  }
}

}  // namespace
}  // namespace waitpoint::executive
