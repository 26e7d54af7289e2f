// SPDX-License-Identifier: BSD-3-Clause
// Values of a map's cells, in square tiles allocated at the first write.
//
// A path between rooms, or an obstacle met on the way, touches a small part of a building's map: initialising every
// cell's node took most of a plan's time and most of a robot's memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace waitpoint::executive {

template <typename Value>
class TiledGrid {
 public:
  /// Without cells and memory.
  TiledGrid() = default;
  /// A grid of `width` x `height` cells that are all `fresh`.
  TiledGrid(std::int32_t width, std::int32_t height, const Value& fresh)
      : fresh_(fresh), tiles_across_((static_cast<std::uint32_t>(width) + side - 1) / side) {
    const std::uint32_t tiles_up = (static_cast<std::uint32_t>(height) + side - 1) / side;
    tile_of_.assign(std::size_t{tiles_across_} * tiles_up, none);
  }

  bool empty() const { return tile_of_.empty(); }

  /// The value of a cell for writing; the reference is valid until a new tile is allocated.
  Value& operator()(std::int32_t x, std::int32_t y) {
    std::uint32_t& tile = tile_of_[tile_index(x, y)];
    if (tile == none) tile = make();
    return tiles_[tile][place(x, y)];
  }
  const Value& operator()(std::int32_t x, std::int32_t y) const {
    const std::uint32_t tile = tile_of_[tile_index(x, y)];
    return tile == none ? fresh_ : tiles_[tile][place(x, y)];
  }

 private:
  static constexpr std::uint32_t side = 32, none = 0xFFFFFFFF;
  using Tile = std::array<Value, std::size_t{side} * side>;

  std::size_t tile_index(std::int32_t x, std::int32_t y) const {
    return std::size_t{static_cast<std::uint32_t>(y) / side} * tiles_across_ + static_cast<std::uint32_t>(x) / side;
  }
  static std::size_t place(std::int32_t x, std::int32_t y) {
    return static_cast<std::uint32_t>(y) % side * side + static_cast<std::uint32_t>(x) % side;
  }
  std::uint32_t make() {
    tiles_.emplace_back().fill(fresh_);
    return static_cast<std::uint32_t>(tiles_.size() - 1);
  }

  Value fresh_{};
  std::uint32_t tiles_across_ = 0;
  std::vector<std::uint32_t> tile_of_;  // index into tiles_ by tile of the grid, row by row
  std::vector<Tile> tiles_;
};

}  // namespace waitpoint::executive
