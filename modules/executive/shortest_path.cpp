// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/shortest_path.hpp"

#include <algorithm>
#include <cstdlib>

namespace waitpoint::executive {
namespace {

struct Step {
  std::int32_t x, y;
  std::uint32_t length;
};

constexpr std::array<Step, 8> steps = {{{1, 0, ShortestPath::straight_step},
                                        {0, 1, ShortestPath::straight_step},
                                        {-1, 0, ShortestPath::straight_step},
                                        {0, -1, ShortestPath::straight_step},
                                        {1, 1, ShortestPath::diagonal_step},
                                        {-1, 1, ShortestPath::diagonal_step},
                                        {-1, -1, ShortestPath::diagonal_step},
                                        {1, -1, ShortestPath::diagonal_step}}};

// A consistent lower bound of the cost between two cells: a step lowers it by at most its own cost.
std::uint32_t least_cost(CellIndex a, CellIndex b) {
  const auto dx = static_cast<std::uint32_t>(std::abs(a.x - b.x));
  const auto dy = static_cast<std::uint32_t>(std::abs(a.y - b.y));
  const std::uint32_t diagonal = std::min(dx, dy), straight = std::max(dx, dy) - diagonal;
  return FreeSpace::least_cell_cost * (ShortestPath::straight_step * straight + ShortestPath::diagonal_step * diagonal);
}

}  // namespace

std::uint32_t ShortestPath::find(const FreeSpace& space, CellIndex start, CellIndex goal,
                                 std::vector<CellIndex>& path) {
  // A step raises the priority by its cost plus the increase of the lower bound.
  static_assert(std::size_t{diagonal_step} *
                    (FreeSpace::greatest_cell_cost + FreeSpace::unseen_cell_cost + FreeSpace::least_cell_cost) <
                bucket_count);
  WAITPOINT_CHECK(space.passable(start) && space.passable(goal), "a way from or to a cell that is not passable");
  path.clear();
  nodes_ = {space.map().width(), space.map().height(), {unreachable, none, false}};
  const std::uint32_t cost = search(space, start, goal, path);
  nodes_ = {};
  buckets_ = {};
  opened_ = 0;
  return cost;
}

std::uint32_t ShortestPath::search(const FreeSpace& space, CellIndex start, CellIndex goal,
                                   std::vector<CellIndex>& path) {
  node(start).cost = 0;
  std::uint32_t priority = least_cost(start, goal);
  open(priority, start);
  while (opened_ > 0) {
    auto& bucket = buckets_[priority % bucket_count];
    if (bucket.empty()) {
      ++priority;
      continue;
    }
    const CellIndex cell = bucket.back();
    bucket.pop_back();
    --opened_;
    Node& reached = node(cell);
    if (reached.closed) continue;
    reached.closed = true;
    if (cell == goal) {
      const std::uint32_t cost = reached.cost;
      walk_back(start, goal, path);
      return cost;
    }
    expand(space, cell, goal);
  }
  return unreachable;
}

void ShortestPath::expand(const FreeSpace& space, CellIndex cell, CellIndex goal) {
  const std::uint32_t cost = node(cell).cost;
  for (std::uint32_t k = 0; k < steps.size(); ++k) {
    const CellIndex next = {cell.x + steps[k].x, cell.y + steps[k].y};
    if (!space.passable(next)) continue;
    Node& neighbour = node(next);
    if (neighbour.closed) continue;
    const std::uint32_t next_cost = cost + steps[k].length * space.cell_cost(next);
    if (next_cost >= neighbour.cost) continue;
    neighbour.cost = next_cost;
    neighbour.came_by = static_cast<std::uint8_t>(k);
    open(next_cost + least_cost(next, goal), next);
  }
}

void ShortestPath::walk_back(CellIndex start, CellIndex goal, std::vector<CellIndex>& path) {
  CellIndex cell = goal;
  path.push_back(cell);
  while (cell != start) {
    const Step& step = steps[node(cell).came_by];
    cell = {cell.x - step.x, cell.y - step.y};
    path.push_back(cell);
  }
  std::reverse(path.begin(), path.end());
}

}  // namespace waitpoint::executive
