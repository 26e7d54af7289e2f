// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/assembly.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "core/missing_part.hpp"
#include "core/number_text.hpp"
#include "modules/executive/known_space.hpp"
#include "modules/run/known_map.hpp"
#include "modules/run/rendezvous.hpp"
#include "modules/scenario/scenario_checks.hpp"
#include "world/bullet/bullet_world.hpp"
#include "world/kinematic/kinematic_world.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::run {
namespace {

/// The map of each robot, shared by robots with the same range of heights.
class KnownMaps {
 public:
  KnownMaps(const scenario::Scenario& scenario, const world::WorldFile* file) : scenario_(scenario), file_(file) {}

  std::shared_ptr<const executive::KnownSpace> of(const scenario::RobotScenario& robot) {
    const world::Shape shape = raised(robot.body.shape, robot.body.start_height_m);
    const std::pair heights(shape.z_low_m, shape.z_high_m);
    auto& map = maps_[heights];
    if (map == nullptr)
      map = std::make_shared<const executive::KnownSpace>(known_map(scenario_, file_, robot), is_known());
    return map;
  }

 private:
  bool is_known() const { return !scenario_.map || scenario_.map->known; }

  const scenario::Scenario& scenario_;
  const world::WorldFile* file_;
  std::map<std::pair<double, double>, std::shared_ptr<const executive::KnownSpace>> maps_;
};

}  // namespace

Assembly::Assembly(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types, io::Network* network,
                   std::uint64_t seed, const Placement& placement, const MakeWorld& make)
    : scenario_(scenario) {
  if (scenario.log)
    throw scenario.log->written.bad("expected a world: a log is played by 'waitpoint run' and 'waitpoint play' only");
  if (scenario.play) throw scenario.play->written.bad("expected a world: a bag is played by 'waitpoint run' only");
  world::WorldDescription description = scenario.world_without_map();
  std::shared_ptr<const world::WorldFile> file;
  if (scenario.map) {
    file = load(*scenario.map);
    description.obstacles.insert(description.obstacles.end(), file->obstacles.begin(), file->obstacles.end());
    description.meshes.insert(description.meshes.end(), file->meshes.begin(), file->meshes.end());
  }
  KnownMaps maps(scenario, file.get());
  scenario::check_on_map(
      scenario, [&](const scenario::RobotScenario& robot) -> const OccupancyGrid& { return maps.of(robot)->map(); },
      file != nullptr && file->grid && scenario.map->known);
  if (file == nullptr || !file->grid) {
    const std::size_t beyond = obstacles_beyond(maps.of(scenario.robots.front())->map(), scenario, file.get());
    if (beyond > 0)
      warnings_.push_back(counted(beyond, "obstacle") + " far from all robots and goals: not on the planners' map");
  }
  scenario::check_starts(scenario, world::start_overlaps(description));
  check_rendezvous(scenario);
  make_world(description, seed, make);
  for (std::size_t i = 0; i < scenario.robots.size(); ++i)
    robots_.push_back(placement.is_here(i)
                          ? std::make_unique<bridge::Robot>(scenario.robots[i], types, maps.of(scenario.robots[i]),
                                                            *world_, world::BodyId(i), network, seed)
                          : std::make_unique<bridge::Robot>(scenario.robots[i], *world_, world::BodyId(i)));
  warnings_.insert(warnings_.end(), scenario.warnings.begin(), scenario.warnings.end());
  // Robots of one type share a file.
  for (const scenario::RobotScenario& robot : scenario.robots)
    for (const std::string& warning : robot.warnings)
      if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end()) warnings_.push_back(warning);
  check_step();
}

std::shared_ptr<const world::WorldFile> Assembly::load(scenario::MapFile map) {
  map.read();
  const world::WorldFile& file = *map.contents;
  if (map.height_m && file.has_heights)
    throw map.written.bad("expected no height_m: '" + map.file.string() + "' has heights of its own");
  warnings_ = file.warnings;
  if (const std::size_t left_out = file.bodies.size() - map.robots_taken; left_out > 0)
    warnings_.push_back(
        map.file.string() + ": " + counted(left_out, "robot") + " of the file left out: " +
        (map.robots_taken == 0 ? "the robots are the scenario's" : "robots_from_map has no row for them"));
  return map.contents;
}

void Assembly::make_world(const world::WorldDescription& description, std::uint64_t seed, const MakeWorld& make) {
  if (make != nullptr) {
    world_ = make(description);
    return;
  }
  if (scenario_.engine == world::Engine::bullet) {
    scenario::check_dynamic(scenario_, world::loose_overlaps(description));
    world_ = world::make_bullet_world(description, seed);
    if (world_ == nullptr)
      throw scenario_.engine_written.bad(std::string("engine bullet is not in this program: ") + missing_part::bullet);
    return;
  }
  const auto loose = std::count_if(description.obstacles.begin(), description.obstacles.end(),
                                   [](const world::Obstacle& obstacle) { return obstacle.loose(); });
  if (loose > 0)
    warnings_.push_back(counted(static_cast<std::size_t>(loose), "shape") +
                        " with mass_kg treated as fixed: only engine bullet moves shapes");
  world_ = world::make_kinematic_world(description, seed);
}

// A coarse step is legitimate, but rarely intended.
void Assembly::check_step() {
  const bridge::Robot* quickest = nullptr;
  std::size_t quicker = 0;
  for (const auto& robot : robots_) {
    const std::optional<Duration> least = robot->least_period();
    if (!least || scenario_.step <= *least) continue;
    ++quicker;
    if (quickest == nullptr || *least < *quickest->least_period()) quickest = robot.get();
  }
  if (quickest == nullptr) return;
  const std::string others = quicker == 1 ? "" : ", and of " + counted(quicker - 1, "other robot");
  warnings_.push_back("the world's step of " + to_string(scenario_.step) + " s exceeds the least period of " +
                      quickest->name() + "'s software, " + to_string(*quickest->least_period()) + " s" + others);
}

std::size_t Assembly::goals_reached() const {
  std::size_t count = 0;
  for (const auto& robot : robots_) count += robot->goals_reached();
  return count;
}

std::size_t Assembly::goals() const {
  std::size_t count = 0;
  for (const auto& robot : robots_) count += robot->goals();
  return count;
}

bridge::RunResult Assembly::result() const {
  bridge::RunResult result;
  result.scenario = scenario_.name;
  result.warnings = warnings_;
  for (const auto& robot : robots_) result.robots.push_back(robot->result());
  return result;
}

}  // namespace waitpoint::run
