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

// The heading of each step, in sixteenths of a turn.
constexpr std::array<int, 8> heading_of = {0, 4, 8, 12, 2, 6, 10, 14};

// True if the robot can turn in a cell from one heading to another, the shorter way round.
bool can_turn(const FreeSpace& space, CellIndex cell, std::uint32_t from, std::uint32_t to) {
  const int turn = (heading_of[to] - heading_of[from] + 8 + 16) % 16 - 8, step = turn < 0 ? -1 : 1;
  for (int k = 0; k != turn; k += step)
    if (!space.fits(cell, heading_of[from] + k)) return false;
  return true;
}

// True if the robot fits at both ends of the step `k`.
bool can_step(const FreeSpace& space, CellIndex cell, CellIndex next, std::uint32_t k) {
  return (!space.tight(cell) || space.fits(cell, heading_of[k])) &&
         (!space.tight(next) || space.fits(next, heading_of[k]));
}

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
  for (TiledGrid<Node>& nodes : nodes_)
    nodes = {space.map().width(), space.map().height(), {unreachable, none, 0, false}};
  const std::uint32_t cost = search(space, start, goal, path);
  for (TiledGrid<Node>& nodes : nodes_) nodes = {};
  buckets_ = {};
  opened_ = 0;
  return cost;
}

std::uint32_t ShortestPath::search(const FreeSpace& space, CellIndex start, CellIndex goal,
                                   std::vector<CellIndex>& path) {
  node({start}).cost = 0;
  std::uint32_t priority = least_cost(start, goal);
  open(priority, {start});
  while (opened_ > 0) {
    auto& bucket = buckets_[priority % bucket_count];
    if (bucket.empty()) {
      ++priority;
      continue;
    }
    const State state = bucket.back();
    bucket.pop_back();
    --opened_;
    Node& reached = node(state);
    if (reached.closed) continue;
    reached.closed = true;
    if (state.cell == goal) {
      const std::uint32_t cost = reached.cost;
      walk_back(start, state, path);
      return cost;
    }
    expand(space, state, start, goal);
  }
  return unreachable;
}

void ShortestPath::expand(const FreeSpace& space, State state, CellIndex start, CellIndex goal) {
  const auto [cell, heading] = state;
  const std::uint32_t cost = node(state).cost;
  // The robot's heading at the start is not known to the plan.
  const bool turns_freely = cell == start || !space.tight(cell);
  for (std::uint32_t k = 0; k < steps.size(); ++k) {
    const CellIndex next = {cell.x + steps[k].x, cell.y + steps[k].y};
    if (!space.passable(next)) continue;
    const State to = {next, static_cast<std::uint8_t>(space.tight(next) ? k : 0)};
    Node& neighbour = node(to);
    if (neighbour.closed) continue;
    const std::uint32_t next_cost = cost + steps[k].length * space.cell_cost(next);
    if (next_cost >= neighbour.cost) continue;
    if (!can_step(space, cell, next, k) || (!turns_freely && !can_turn(space, cell, heading, k))) continue;
    neighbour.cost = next_cost;
    neighbour.came_by = static_cast<std::uint8_t>(k);
    neighbour.from = heading;
    open(next_cost + least_cost(next, goal), to);
  }
}

void ShortestPath::walk_back(CellIndex start, State goal, std::vector<CellIndex>& path) {
  State state = goal;
  path.push_back(state.cell);
  while (state.cell != start) {
    const Node& reached = node(state);
    const Step& step = steps[reached.came_by];
    state = {{state.cell.x - step.x, state.cell.y - step.y}, reached.from};
    path.push_back(state.cell);
  }
  std::reverse(path.begin(), path.end());
}

}  // namespace waitpoint::executive
