// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/merged_cells.hpp"

#include <cstdint>

#include "core/error.hpp"
#include "world/formats/limits.hpp"

namespace waitpoint::world {
namespace {

class Merger {
 public:
  Merger(const OccupancyGrid& grid, const std::string& file)
      : grid_(grid),
        file_(file),
        covered_(static_cast<std::size_t>(grid.width()) * static_cast<std::size_t>(grid.height()), 0) {}

  std::vector<CellBlock> run() {
    std::vector<CellBlock> blocks;
    for (int y = 0; y < grid_.height(); ++y) {
      for (int x = 0; x < grid_.width(); ++x) {
        if (!open(x, y)) continue;
        if (blocks.size() == obstacle_count_max) {
          throw BadInput(file_, "expected a map of at most " + std::to_string(obstacle_count_max) +
                                    " blocks of occupied cells, found more");
        }
        const CellBlock wide = grown_wide(x, y), tall = grown_tall(x, y);
        const bool prefer_wide = area(wide) >= area(tall);
        blocks.push_back(prefer_wide ? wide : tall);
        cover(blocks.back());
      }
    }
    return blocks;
  }

 private:
  static std::int64_t area(const CellBlock& b) { return std::int64_t{b.width} * b.height; }

  std::size_t offset(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.width()) + static_cast<std::size_t>(x);
  }
  bool open(int x, int y) const {
    return grid_.contains({x, y}) && grid_[{x, y}] == Cell::occupied && covered_[offset(x, y)] == 0;
  }
  bool row_open(const CellBlock& b, int y) const {
    for (int x = b.x; x < b.x + b.width; ++x) {
      if (!open(x, y)) return false;
    }
    return true;
  }
  bool column_open(const CellBlock& b, int x) const {
    for (int y = b.y; y < b.y + b.height; ++y) {
      if (!open(x, y)) return false;
    }
    return true;
  }

  CellBlock grown_wide(int x, int y) const {
    CellBlock b = {x, y, 1, 1};
    while (column_open(b, b.x + b.width)) ++b.width;
    while (row_open(b, b.y + b.height)) ++b.height;
    return b;
  }
  CellBlock grown_tall(int x, int y) const {
    CellBlock b = {x, y, 1, 1};
    while (row_open(b, b.y + b.height)) ++b.height;
    while (column_open(b, b.x + b.width)) ++b.width;
    return b;
  }

  void cover(const CellBlock& b) {
    for (int y = b.y; y < b.y + b.height; ++y) {
      for (int x = b.x; x < b.x + b.width; ++x) covered_[offset(x, y)] = 1;
    }
  }

  const OccupancyGrid& grid_;
  const std::string& file_;
  std::vector<std::uint8_t> covered_;
};

}  // namespace

std::vector<CellBlock> merged_occupied_cells(const OccupancyGrid& grid, const std::string& file) {
  return Merger(grid, file).run();
}

std::vector<Obstacle> obstacles_of(const OccupancyGrid& grid, const std::string& name, double z_low_m, double z_high_m,
                                   const std::string& file) {
  std::vector<Obstacle> obstacles;
  const double cell = grid.resolution_m();
  for (const CellBlock& block : merged_occupied_cells(grid, file)) {
    Obstacle obstacle;
    obstacle.name = name + " " + std::to_string(obstacles.size());
    const Pose centre = {(block.x + 0.5 * block.width) * cell, (block.y + 0.5 * block.height) * cell, 0};
    obstacle.shape.pose = compose(grid.origin(), centre);
    obstacle.shape.length_m = block.width * cell;
    obstacle.shape.width_m = block.height * cell;
    obstacle.shape.z_low_m = z_low_m;
    obstacle.shape.z_high_m = z_high_m;
    obstacles.push_back(obstacle);
  }
  return obstacles;
}

}  // namespace waitpoint::world
