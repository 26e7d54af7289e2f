// SPDX-License-Identifier: BSD-3-Clause
// One simulated robot: its modules, its bridge to the world and its executive, in a name space of its own.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "fibers/io/network.hpp"
#include "fibers/sync/simulation.hpp"
#include "modules/bridge/evaluation.hpp"
#include "modules/bridge/robot_bridge.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/bridge/scenario.hpp"
#include "modules/executive/executive.hpp"
#include "modules/genom/module_type.hpp"
#include "world/world.hpp"

namespace waitpoint::bridge {

class Robot {
 public:
  /// Makes and connects everything. What does not fit together is BadInput, naming the scenario's line. The scenario,
  /// the world and the network must outlive the robot.
  Robot(const RobotScenario& scenario, std::span<const genom::ModuleType> types, const OccupancyGrid& map,
        world::World& world, world::BodyId body, io::Network& network, std::uint64_t seed);

  /// Adds the robot's tasks to a run that has not begun. A robot with goals is alive until its executive ends; one
  /// without does not keep the run alive.
  void spawn(Simulation& simulation);

  /// After a step of the world, from the world's task.
  void stepped(Time now);

  const std::string& name() const { return scenario_.name; }
  genom::NameSpace& names() { return names_; }
  std::size_t goals() const { return scenario_.goals.size(); }
  std::size_t goals_reached() const;
  /// The least period of all execution tasks; nothing if none is periodic.
  std::optional<Duration> least_period() const;
  RobotResult result() const;

 private:
  void make_modules(std::span<const genom::ModuleType> types, io::Network& network);
  void make_executive(const OccupancyGrid& map, std::uint64_t seed);
  void connect();

  const RobotScenario& scenario_;
  world::World& world_;
  world::BodyId body_;
  genom::NameSpace names_;
  std::vector<std::unique_ptr<genom::Module>> modules_;
  std::vector<const ModuleScenario*> module_scenarios_;  // of each module
  RobotBridge bridge_;
  std::optional<executive::Executive> executive_;
  Evaluation evaluation_;
  const kernel::Robot* lane_ = nullptr;
};

}  // namespace waitpoint::bridge
