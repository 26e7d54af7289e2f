// SPDX-License-Identifier: BSD-3-Clause
// One run of a scenario, put together and carried out: the world, its robots, all their tasks in one simulation.
//
//   at every multiple of the world's step, in the world's phase:
//     the world's task: step; evaluation; tells the bridges
//     each robot's bridge: readings to posters, commands from posters
//   then the robots' tasks of that instant
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fibers/io/network.hpp"
#include "fibers/sync/simulation.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/run/assembly.hpp"
#include "modules/run/operator.hpp"
#include "modules/run/robot_program.hpp"

namespace waitpoint::run {

struct ExperimentOptions {
  std::uint64_t seed = 0;
  kernel::Order order = kernel::Order::fifo;
  std::string replay;  ///< the line that repeats the run, for reports
};

class Experiment {
 public:
  /// Everything that can be wrong with the input is found here, as BadInput. The scenario must outlive the experiment.
  Experiment(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types,
             const ExperimentOptions& options);

  /// Ends every task that is left, those of programs too. Nothing can be run afterwards.
  void unwind();

  /// Carries out everything before `until`; may be called again with a later time, in windows of any size.
  RunEnd run_before(Time until);
  /// The same, but `enough` is asked after each event, and where it says so the run pauses before the next: paused().
  /// `enough` must only look and not throw.
  RunEnd run_before(Time until, const std::function<bool(const kernel::EventRecord&)>& enough);
  bool paused() const { return paused_; }

  /// To be carried out at a step of the world: the next one, or the first not before `date`. Returns when that is. What
  /// this run does not have, or a date that is past, is BadInput. What came of it: outcomes().
  Time intervene(Intervention intervention, std::optional<Time> date = std::nullopt);
  /// To be called after each step of the world; must only look and not throw.
  void set_observer(std::function<void(Time now)> observer) { observer_ = std::move(observer); }
  const std::vector<InterventionOutcome>& outcomes() const { return operator_->outcomes(); }

  Simulation& simulation() { return simulation_; }
  io::Network& network() { return *network_; }
  const world::World& world() const { return assembly_->world(); }
  const std::vector<std::unique_ptr<bridge::Robot>>& robots() const { return assembly_->robots(); }
  /// Goals reached so far, and all there are.
  std::size_t goals_reached() const { return assembly_->goals_reached(); }
  std::size_t goals() const { return assembly_->goals(); }

  /// Of what has come out so far, the figures that expectations are about: at no cost.
  bridge::RunTotals figures() const;
  /// What has come out so far.
  bridge::RunResult result() const;

 private:
  void make_network(const scenario::Scenario& scenario);
  const world::BodyState* body_of(const std::string& robot) const;
  void spawn(bridge::Robot& robot);
  void run_world();

  ExperimentOptions options_;
  std::optional<io::Network> network_;  // before the robots, whose modules have sockets
  std::optional<Assembly> assembly_;
  std::vector<kernel::Robot*> lanes_;  // of each robot
  std::optional<Operator> operator_;
  std::function<void(Time now)> observer_;
  Simulation simulation_;                            // after what its tasks use: it goes first
  RobotPrograms programs_{simulation_.scheduler()};  // after that: what is left of them must not be unwound
  RunEnd end_ = RunEnd::time_reached;
  bool paused_ = false;
};

}  // namespace waitpoint::run
