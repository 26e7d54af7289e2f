// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/shortest_path.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

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

}  // namespace

std::uint32_t ShortestPath::find(const FreeSpace& space, CellIndex start, CellIndex goal,
                                 std::vector<CellIndex>& path) {
  // A step raises the priority by its cost plus the increase of the lower bound.
  static_assert(std::size_t{diagonal_step} *
                    (FreeSpace::greatest_cell_cost + FreeSpace::unseen_cell_cost + FreeSpace::least_cell_cost) <
                bucket_count);
  static_assert(std::size_t{diagonal_step} * (2 * FreeSpace::greatest_cell_cost + FreeSpace::unseen_cell_cost) <
                2 * bucket_count);
  WAITPOINT_CHECK(space.passable(start) && space.passable(goal), "a way from or to a cell that is not passable");
  path.clear();
  buckets_.resize(space.has_seen() ? 2 * bucket_count : bucket_count);
  if (!space.has_seen())
    costs_goal_.reset();
  else if (costs_goal_ != goal)
    find_costs_to(space, goal);
  for (TiledGrid<Node>& nodes : nodes_)
    nodes = {space.map().width(), space.map().height(), {unreachable, none, 0, false}};
  const std::uint32_t cost = search(space, start, goal, path);
  for (TiledGrid<Node>& nodes : nodes_) nodes = {};
  buckets_ = {};
  opened_ = 0;
  return cost;
}

// A consistent lower bound of the cost between two cells: a step lowers it by at most its own cost.
std::uint32_t ShortestPath::least_cost(CellIndex from, CellIndex goal) const {
  if (costs_goal_) return std::as_const(costs_to_)(from.x, from.y);
  const auto dx = static_cast<std::uint32_t>(std::abs(from.x - goal.x));
  const auto dy = static_cast<std::uint32_t>(std::abs(from.y - goal.y));
  const std::uint32_t diagonal = std::min(dx, dy), straight = std::max(dx, dy) - diagonal;
  return FreeSpace::least_cell_cost * (straight_step * straight + diagonal_step * diagonal);
}

std::optional<ShortestPath::State> ShortestPath::take_least(std::uint32_t& priority) {
  if (opened_ == 0) return std::nullopt;
  while (buckets_[priority % buckets_.size()].empty()) ++priority;
  auto& bucket = buckets_[priority % buckets_.size()];
  const State state = bucket.back();
  bucket.pop_back();
  --opened_;
  return state;
}

// Backwards from the goal: a step has the cost of entering its end.
void ShortestPath::find_costs_to(const FreeSpace& space, CellIndex goal) {
  costs_goal_ = goal;
  costs_to_ = {space.map().width(), space.map().height(), unreachable};
  costs_to_(goal.x, goal.y) = 0;
  std::uint32_t cost = 0;
  open(cost, {goal});
  while (const std::optional<State> state = take_least(cost)) {
    const CellIndex cell = state->cell;
    if (costs_to_(cell.x, cell.y) < cost) continue;
    const std::uint32_t enter = space.known_cell_cost(cell);
    for (const Step& step : steps) {
      const CellIndex before = {cell.x + step.x, cell.y + step.y};
      if (!space.known_passable(before)) continue;
      std::uint32_t& from = costs_to_(before.x, before.y);
      if (cost + step.length * enter >= from) continue;
      from = cost + step.length * enter;
      open(from, {before});
    }
  }
}

std::uint32_t ShortestPath::search(const FreeSpace& space, CellIndex start, CellIndex goal,
                                   std::vector<CellIndex>& path) {
  std::uint32_t priority = least_cost(start, goal);
  if (priority == unreachable) return unreachable;
  node({start}).cost = 0;
  open(priority, {start});
  while (const std::optional<State> state = take_least(priority)) {
    Node& reached = node(*state);
    if (reached.closed) continue;
    reached.closed = true;
    if (state->cell == goal) {
      const std::uint32_t cost = reached.cost;
      walk_back(start, *state, path);
      return cost;
    }
    expand(space, *state, start, goal);
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
