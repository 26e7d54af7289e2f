// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/experiment.hpp"

#include "modules/bridge/known_map.hpp"
#include "modules/bridge/scenario_checks.hpp"
#include "world/fcl/fcl_world.hpp"
#include "world/formats/map_server.hpp"
#include "world/formats/merged_cells.hpp"

namespace waitpoint::bridge {
namespace {

GoalPlace place_on(const OccupancyGrid& map, Point goal) {
  const std::optional<CellIndex> cell = map.cell_at(goal);
  if (!cell || map[*cell] == Cell::unknown) return GoalPlace::outside_map;
  return map[*cell] == Cell::occupied ? GoalPlace::inside_obstacle : GoalPlace::free;
}

}  // namespace

Experiment::Experiment(const Scenario& scenario, std::span<const genom::ModuleType> types,
                       const ExperimentOptions& options)
    : scenario_(scenario), options_(options), simulation_({options.order, options.seed, options.replay}) {
  world::WorldDescription description = scenario.world_without_map();
  std::optional<OccupancyGrid> map_file;
  if (scenario.map) {
    map_file = world::read_map_server_map(scenario.map->file.string());
    for (world::Obstacle& obstacle : world::obstacles_of(*map_file, "map", 0, scenario.map->height_m))
      description.obstacles.push_back(std::move(obstacle));
  }
  const OccupancyGrid map = known_map(scenario, map_file ? &*map_file : nullptr);
  check_goals(scenario, [&](const RobotScenario&, Point goal) { return place_on(map, goal); });
  check_starts(scenario, world::start_overlaps(description));
  world_ = world::make_fcl_world(description, options.seed);
  make_network();
  for (std::size_t i = 0; i < scenario.robots.size(); ++i)
    robots_.push_back(
        std::make_unique<Robot>(scenario.robots[i], types, map, *world_, world::BodyId(i), *network_, options.seed));
  check_step();

  simulation_.spawn(
      simulation_.environment(),
      {.name = "world", .stack = kernel::StackSize::large, .phase = kernel::Phase::world, .service = true},
      [this] { run_world(); });
  for (const auto& robot : robots_) robot->spawn(simulation_);
}

// Distances are those of the true positions at the last step of the world.
void Experiment::make_network() {
  network_.emplace(simulation_);
  if (scenario_.medium) network_->declare(*scenario_.medium);
  network_->set_distance([this](const std::string& from, const std::string& to) {
    const world::BodyState* const a = body_of(from);
    const world::BodyState* const b = body_of(to);
    // The environment's tasks are nowhere.
    return a != nullptr && b != nullptr ? length(b->pose.position() - a->pose.position()) : 0;
  });
}

// A coarse step is a legitimate choice, but rarely meant.
void Experiment::check_step() {
  for (const auto& robot : robots_) {
    const std::optional<Duration> least = robot->least_period();
    if (!least || scenario_.step <= *least) continue;
    warnings_.push_back("the world's step of " + to_string(scenario_.step) + " s exceeds the least period of " +
                        robot->name() + "'s software, " + to_string(*least) + " s");
  }
}

const world::BodyState* Experiment::body_of(const std::string& robot) const {
  for (std::size_t i = 0; i < scenario_.robots.size(); ++i)
    if (scenario_.robots[i].name == robot) return &world_->body(world::BodyId(i));
  return nullptr;
}

void Experiment::run_world() {
  for (std::int64_t k = 1;; ++k) {
    this_thread::sleep_until(Time() + scenario_.step * k);
    world_->step();
    for (const auto& robot : robots_) robot->stepped(now());
  }
}

RunEnd Experiment::run_before(Time until) {
  end_ = simulation_.run_before(until);
  return end_;
}

std::size_t Experiment::goals_reached() const {
  std::size_t count = 0;
  for (const auto& robot : robots_) count += robot->goals_reached();
  return count;
}

std::size_t Experiment::goals() const {
  std::size_t count = 0;
  for (const auto& robot : robots_) count += robot->goals();
  return count;
}

RunResult Experiment::result() const {
  RunResult result;
  result.scenario = scenario_.name;
  result.seed = options_.seed;
  result.digest = simulation_.digest();
  result.environment_digest = simulation_.environment().digest.digest();
  for (const auto& robot : robots_) result.robots.push_back(robot->result());
  result.warnings = warnings_;
  result.events = simulation_.scheduler().events();
  result.deadlock = simulation_.trouble();
  result.outcome = end_ == RunEnd::ended          ? Outcome::finished
                   : end_ == RunEnd::time_reached ? Outcome::time_limit
                                                  : Outcome::deadlock;
  return result;
}

}  // namespace waitpoint::bridge
