// SPDX-License-Identifier: BSD-3-Clause
// What a search knows of the cells of a grid, in square tiles that are made when the search first comes there.
//
// A way from room to room touches a small part of a building's map: clearing every cell's node took most of the time of
// a plan, and most of a robot's memory. The memory of the tiles is kept for the next search.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace waitpoint::executive {

template <typename Node>
class SearchGrid {
 public:
  /// Begins anew on a grid of `width` x `height` cells, each with this node.
  void begin(std::int32_t width, std::int32_t height, const Node& fresh) {
    fresh_ = fresh;
    tiles_across_ = (static_cast<std::uint32_t>(width) + side - 1) / side;
    const std::uint32_t tiles_up = (static_cast<std::uint32_t>(height) + side - 1) / side;
    tile_of_.assign(std::size_t{tiles_across_} * tiles_up, none);
    made_ = 0;
  }

  /// The node of a cell of the grid; stays where it is until another tile is come to.
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
  std::vector<std::uint32_t> tile_of_;  // where the grid's tiles are among those made, row by row
  std::vector<Tile> tiles_;             // the first made_ are of this search
};

}  // namespace waitpoint::executive
