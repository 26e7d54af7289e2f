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

#include "fibers/io/network.hpp"
#include "fibers/sync/simulation.hpp"
#include "modules/bridge/assembly.hpp"

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
  io::Network& network() { return *network_; }
  const world::World& world() const { return assembly_->world(); }
  const std::vector<std::unique_ptr<Robot>>& robots() const { return assembly_->robots(); }
  /// Goals reached so far, and all there are.
  std::size_t goals_reached() const { return assembly_->goals_reached(); }
  std::size_t goals() const { return assembly_->goals(); }

  /// What has come out so far.
  RunResult result() const;

 private:
  void make_network(const Scenario& scenario);
  const world::BodyState* body_of(const std::string& robot) const;
  void spawn(Robot& robot);
  void run_world();

  ExperimentOptions options_;
  std::optional<io::Network> network_;  // before the robots, whose modules have sockets
  std::optional<Assembly> assembly_;
  std::vector<const kernel::Robot*> lanes_;  // of each robot
  Simulation simulation_;                    // after what its tasks use: it goes first
  RunEnd end_ = RunEnd::time_reached;
};

}  // namespace waitpoint::bridge
