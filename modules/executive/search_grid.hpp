// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a grid search, in square tiles allocated on first access.
//
// A path between rooms touches a small part of a building's map: initialising every cell's node took most of a plan's
// time and most of a robot's memory. The memory of the tiles is kept for the next search.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace waitpoint::executive {

template <typename Node>
class SearchGrid {
 public:
  /// Resets to a grid of `width` x `height` cells whose nodes are all `fresh`.
  void begin(std::int32_t width, std::int32_t height, const Node& fresh) {
    fresh_ = fresh;
    tiles_across_ = (static_cast<std::uint32_t>(width) + side - 1) / side;
    const std::uint32_t tiles_up = (static_cast<std::uint32_t>(height) + side - 1) / side;
    tile_of_.assign(std::size_t{tiles_across_} * tiles_up, none);
    made_ = 0;
  }

  /// The node of a cell; the reference is valid until a new tile is allocated.
  Node& operator()(std::int32_t x, std::int32_t y) {
    const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
    std::uint32_t& tile = tile_of_[std::size_t{row / side} * tiles_across_ + column / side];
    if (tile == none) tile = make();
    return tiles_[tile][row % side * side + column % side];
  }

 private:
  static constexpr std::uint32_t side = 32, none = 0xFFFFFFFF;
  using Tile = std::array<Node, std::size_t{side} * side>;

  std::uint32_t make() {
    if (made_ == tiles_.size()) tiles_.emplace_back();
    tiles_[made_].fill(fresh_);
    return made_++;
  }

  Node fresh_{};
  std::uint32_t tiles_across_ = 0, made_ = 0;
  std::vector<std::uint32_t> tile_of_;  // index into tiles_ by tile of the grid, row by row
  std::vector<Tile> tiles_;             // the first made_ belong to this search
};

}  // namespace waitpoint::executive
