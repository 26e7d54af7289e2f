// SPDX-License-Identifier: BSD-3-Clause
// The cheapest path over passable cells: A* on the 8-connected grid, in integers.
//
// A straight step costs 5, a diagonal one 7 times the cost of the cell entered. Entries of equal priority are taken in
// a fixed order, so the path is a function of the map alone. The open list is a ring of buckets (Dial 1969): priorities
// never decrease, and a step increases them by less than the ring's size. A search leaves no memory allocated: the
// robots of a day's run would each come to hold that of their greatest search.
//
// A robot that plans again and again on its view goes to one goal meanwhile: its costs from all cells by the known
// map alone are computed once, and kept. Seen obstacles only raise them, so they are lower bounds, of which the search
// visits little more than the path.
//
// In tight cells (free_space.hpp) a state of the search is a cell with a heading, that of the step into it, and the
// robot turns there only as far as its hull sweeps free space; elsewhere it turns freely, and all headings are one
// state.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "modules/executive/free_space.hpp"
#include "modules/executive/tiled_grid.hpp"

namespace waitpoint::executive {

class ShortestPath {
 public:
  static constexpr std::uint32_t straight_step = 5, diagonal_step = 7;
  static constexpr std::uint32_t unreachable = 0xFFFFFFFF;

  /// Searches between two passable cells; `path` receives the cells, both ends included. Returns the cost;
  /// `unreachable` and an empty path if there is no way.
  std::uint32_t find(const FreeSpace& space, CellIndex start, CellIndex goal, std::vector<CellIndex>& path);

 private:
  struct State {
    CellIndex cell;
    std::uint8_t heading = 0;  // an index of a step; 0 unless the cell is tight
  };
  struct Node {
    std::uint32_t cost;
    std::uint8_t came_by;  // the direction of the last step, or `none`
    std::uint8_t from;     // the heading of the state before
    bool closed;
  };
  static constexpr std::size_t bucket_count = 1024;  // twice as many with the costs from all cells
  static constexpr std::uint8_t none = 255;

  void open(std::uint32_t priority, State state) { buckets_[priority % buckets_.size()].push_back(state), ++opened_; }
  std::optional<State> take_least(std::uint32_t& priority);
  std::uint32_t least_cost(CellIndex from, CellIndex goal) const;
  void find_costs_to(const FreeSpace& space, CellIndex goal);
  std::uint32_t search(const FreeSpace& space, CellIndex start, CellIndex goal, std::vector<CellIndex>& path);
  void expand(const FreeSpace& space, State state, CellIndex start, CellIndex goal);
  void walk_back(CellIndex start, State goal, std::vector<CellIndex>& path);
  Node& node(State state) { return nodes_[state.heading](state.cell.x, state.cell.y); }

  std::array<TiledGrid<Node>, 8> nodes_;  // by heading
  std::vector<std::vector<State>> buckets_;
  std::size_t opened_ = 0;
  TiledGrid<std::uint32_t> costs_to_;  // to costs_goal_, by the known map
  std::optional<CellIndex> costs_goal_;
};

}  // namespace waitpoint::executive
