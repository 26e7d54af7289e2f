// SPDX-License-Identifier: BSD-3-Clause
// Values of a map's cells, in square tiles allocated at the first write.
//
// A path between rooms, or an obstacle met on the way, touches a small part of a building's map: initialising every
// cell's node took most of a plan's time and most of a robot's memory. The tiles are found through blocks of tiles,
// also allocated at the first write: of a map of a thousand floors, a table of all tiles would be a megabyte in each
// robot.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace waitpoint::executive {

template <typename Value>
class TiledGrid {
 public:
  /// Without cells and memory.
  TiledGrid() = default;
  /// A grid of `width` x `height` cells that are all `fresh`.
  TiledGrid(std::int32_t width, std::int32_t height, const Value& fresh)
      : fresh_(fresh), blocks_across_(blocks(width)), blocks_(std::size_t{blocks_across_} * blocks(height)) {}

  bool empty() const { return blocks_.empty(); }

  /// The value of a cell for writing.
  Value& operator()(std::int32_t x, std::int32_t y) {
    const Place at(x, y);
    std::unique_ptr<Block>& block = blocks_[block_index(at)];
    if (block == nullptr) block = std::make_unique<Block>();
    std::unique_ptr<Tile>& tile = (*block)[at.in_block];
    if (tile == nullptr) (tile = std::make_unique_for_overwrite<Tile>())->fill(fresh_);
    return (*tile)[at.in_tile];
  }
  const Value& operator()(std::int32_t x, std::int32_t y) const {
    const Place at(x, y);
    const Block* const block = blocks_[block_index(at)].get();
    const Tile* const tile = block == nullptr ? nullptr : (*block)[at.in_block].get();
    return tile == nullptr ? fresh_ : (*tile)[at.in_tile];
  }

 private:
  static constexpr std::uint32_t tile_side = 32, block_side = 16;  // in cells, in tiles
  using Tile = std::array<Value, std::size_t{tile_side} * tile_side>;
  using Block = std::array<std::unique_ptr<Tile>, std::size_t{block_side} * block_side>;

  // A cell's place: its block, its tile in the block, the cell in the tile.
  struct Place {
    Place(std::int32_t column, std::int32_t row)
        : Place(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)) {}
    Place(std::uint32_t x, std::uint32_t y)
        : block_x(x / (tile_side * block_side)),
          block_y(y / (tile_side * block_side)),
          in_block(y / tile_side % block_side * block_side + x / tile_side % block_side),
          in_tile(y % tile_side * tile_side + x % tile_side) {}
    std::uint32_t block_x, block_y, in_block, in_tile;
  };
  static std::uint32_t blocks(std::int32_t cells) {
    return (static_cast<std::uint32_t>(cells) + tile_side * block_side - 1) / (tile_side * block_side);
  }
  std::size_t block_index(const Place& at) const { return std::size_t{at.block_y} * blocks_across_ + at.block_x; }

  Value fresh_{};
  std::uint32_t blocks_across_ = 0;
  std::vector<std::unique_ptr<Block>> blocks_;  // row by row
};

}  // namespace waitpoint::executive
