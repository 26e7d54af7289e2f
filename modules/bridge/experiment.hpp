// SPDX-License-Identifier: BSD-3-Clause
// One run of a scenario, put together and carried out: the world, its robots, all their tasks in one simulation.
//
//   at every multiple of the world's step, in the world's phase:
//     the world's task: step; evaluation; tells the bridges
//     each robot's bridge: readings to posters, commands from posters
//   then the robots' tasks of that instant
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "fibers/io/network.hpp"
#include "fibers/sync/simulation.hpp"
#include "modules/bridge/robot.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/bridge/scenario.hpp"
#include "world/world.hpp"

namespace waitpoint::bridge {

struct ExperimentOptions {
  std::uint64_t seed = 0;
  kernel::Order order = kernel::Order::fifo;
  std::string replay;  ///< the line that repeats the run, for reports
};

class Experiment {
 public:
  /// Everything that can be wrong with the input is found here, as BadInput. The scenario must outlive the experiment.
  Experiment(const Scenario& scenario, std::span<const genom::ModuleType> types, const ExperimentOptions& options);

  /// Carries out everything before `until`; may be called again with a later time, in windows of any size.
  RunEnd run_before(Time until);

  Simulation& simulation() { return simulation_; }
  const world::World& world() const { return *world_; }
  io::Network& network() { return *network_; }
  const std::vector<std::unique_ptr<Robot>>& robots() const { return robots_; }
  /// Goals reached so far, and all there are.
  std::size_t goals_reached() const;
  std::size_t goals() const;

  /// What has come out so far.
  RunResult result() const;

 private:
  void check_step();
  void make_network();
  const world::BodyState* body_of(const std::string& robot) const;
  void run_world();

  const Scenario& scenario_;
  ExperimentOptions options_;
  std::vector<std::string> warnings_;
  std::unique_ptr<world::World> world_;
  std::optional<io::Network> network_;  // before the robots, whose modules have sockets
  std::vector<std::unique_ptr<Robot>> robots_;
  Simulation simulation_;  // after what its tasks use: it goes first
  RunEnd end_ = RunEnd::time_reached;
};

}  // namespace waitpoint::bridge
