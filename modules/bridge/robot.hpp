// SPDX-License-Identifier: BSD-3-Clause
// One robot: its modules, its bridge to the world and its executive, in a name space of its own.
//
// Which tasks do its parts is for whoever carries out the run to say: an Experiment, or a
// ThreadedExperiment.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "modules/bridge/evaluation.hpp"
#include "modules/bridge/robot_bridge.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/executive/executive.hpp"
#include "modules/genom/module_type.hpp"
#include "modules/genom/task_computing.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/world.hpp"

namespace waitpoint::bridge {

class Robot {
 public:
  /// Makes and connects everything. What does not fit together is BadInput, naming the scenario's line. The scenario,
  /// the world and the network, null where there is none, must outlive the robot.
  Robot(const scenario::RobotScenario& scenario, std::span<const genom::ModuleType> types,
        std::shared_ptr<const executive::KnownSpace> known, world::World& world, world::BodyId body,
        io::Network* network, std::uint64_t seed);

  /// The task of the robot's software: starts the modules, then carries out the round of goals, if there is any.
  void run();
  /// From another task: the round is left and the robot stopped.
  void stop();
  /// After run(): ends the modules, from a task; a module that does not end is a bug.
  void end_modules();

  /// Tells `watch` what the modules do. Before run(); `watch` must outlive the robot's tasks. Null: nobody.
  void set_watch(genom::ModuleWatch* watch);

  RobotBridge& bridge() { return bridge_; }
  /// Compares what the robot believes with the truth, after a step of the world.
  void observe(Time now) { evaluation_.observe(now, world_.body(body_)); }

  /// Asks for the memory that an observation touches, in two steps.
  void fetch_evaluation() const { evaluation_.fetch_itself(); }
  void fetch_path() const { evaluation_.fetch_path(); }

  double position_error_max_m() const { return evaluation_.position_error_max_m(); }

  const std::string& name() const { return scenario_.name; }
  genom::NameSpace& names() { return names_; }
  const genom::NameSpace& names() const { return names_; }
  std::size_t goals() const { return scenario_.goals.size(); }
  std::size_t goals_reached() const;
  /// How the task of run() computes, as the scenario says.
  const genom::TaskComputing& computing() const { return computing_; }
  /// The least period of all execution tasks; nothing if none is periodic.
  std::optional<Duration> least_period() const;
  /// Without its digest, which is the run's to know.
  RobotResult result() const;

 private:
  void make_modules(std::span<const genom::ModuleType> types, io::Network* network);
  void make_executive(std::shared_ptr<const executive::KnownSpace> known, std::uint64_t seed);
  void connect();

  const scenario::RobotScenario& scenario_;
  world::World& world_;
  world::BodyId body_;
  genom::NameSpace names_;
  std::vector<std::unique_ptr<genom::Module>> modules_;
  std::vector<const scenario::ModuleScenario*> module_scenarios_;  // of each module
  RobotBridge bridge_;
  genom::TaskComputing computing_;
  std::optional<executive::Executive> executive_;
  Evaluation evaluation_;
};

/// Which of `robots` has that name; BadInput at `written` if none has.
std::size_t index_of(std::string_view name, const std::vector<std::unique_ptr<Robot>>& robots,
                     const scenario::Location& written);

}  // namespace waitpoint::bridge
