// SPDX-License-Identifier: BSD-3-Clause
// One run of a scenario: its world, its robots and all their tasks in one simulation.
//
//   at every multiple of the world's step, in the world's phase:
//     the world's task: step; evaluation; release of the bridges
//     each robot's bridge: readings to posters, commands from posters
//   then the robots' tasks at that instant
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
  /// Bad input of any kind is found here, as BadInput. The scenario must outlive the experiment.
  Experiment(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types,
             const ExperimentOptions& options);

  /// Ends all remaining tasks, including those of programs. The run cannot be continued.
  void unwind();

  /// Runs all events before `until`. May be called again with a later time; windows have any size.
  RunEnd run_before(Time until);
  /// The same, but pauses before the next event when `enough`, called after each event, returns true: see paused().
  /// `enough` must not change anything or throw.
  RunEnd run_before(Time until, const std::function<bool(const kernel::EventRecord&)>& enough);
  bool paused() const { return paused_; }

  /// Schedules an intervention for a step of the world: the next one, or the first at or after `date`. Returns the time
  /// of that step. An unknown robot, obstacle, module, request or field, or a date in the past, is BadInput. Its result
  /// appears in outcomes().
  Time intervene(Intervention intervention, std::optional<Time> date = std::nullopt);
  /// Called after each step of the world; must not change anything or throw.
  void set_observer(std::function<void(Time now)> observer) { observer_ = std::move(observer); }
  const std::vector<InterventionOutcome>& outcomes() const { return operator_->outcomes(); }

  Simulation& simulation() { return simulation_; }
  io::Network& network() { return *network_; }
  const world::World& world() const { return assembly_->world(); }
  const std::vector<std::unique_ptr<bridge::Robot>>& robots() const { return assembly_->robots(); }
  /// Goals reached so far, and the number of goals, over all robots.
  std::size_t goals_reached() const { return assembly_->goals_reached(); }
  std::size_t goals() const { return assembly_->goals(); }

  /// The tasks that have waited without a timeout for `least` of virtual time (sync::describe_idle), for people.
  std::string idle(Duration least);
  /// The figures so far that expectations refer to; cheap.
  bridge::RunTotals figures() const;
  /// The result so far.
  bridge::RunResult result() const;

 private:
  void make_network(const scenario::Scenario& scenario);
  const world::BodyState* body_of(const std::string& robot) const;
  void spawn_robots(const scenario::Scenario& scenario);
  void spawn(bridge::Robot& robot);
  void run_world();

  ExperimentOptions options_;
  std::optional<io::Network> network_;  // destroyed after the robots, whose modules have sockets
  std::optional<Assembly> assembly_;
  std::vector<kernel::Robot*> lanes_;  // by robot
  std::optional<Operator> operator_;
  std::function<void(Time now)> observer_;
  Simulation simulation_;                            // destroyed before the objects that its tasks use
  RobotPrograms programs_{simulation_.scheduler()};  // destroyed first: its tasks must not be unwound
  RunEnd end_ = RunEnd::time_reached;
  bool paused_ = false;
};

}  // namespace waitpoint::run
