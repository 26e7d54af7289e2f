// SPDX-License-Identifier: BSD-3-Clause
// One run of a scenario: its world, its robots and all their tasks in one simulation.
//
//   at every multiple of the world's step, in the world's phase:
//     the world's task: step; evaluation; release of the bridges
//     each robot's bridge: readings to posters, commands from posters
//   then the robots' tasks at that instant
//
// When the last task but services has ended, the run goes on to the next step of the world, where it ends: so robots
// without goals end at an instant that does not depend on where in the step another robot ended. In the explored order
// the run ends at once: nothing is left to explore.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fibers/io/network.hpp"
#include "fibers/kernel/watch.hpp"
#include "fibers/sync/simulation.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/run/assembly.hpp"
#include "modules/run/operator.hpp"
#include "modules/run/ranked_run.hpp"
#include "modules/run/robot_program.hpp"

namespace waitpoint::run {

struct ExperimentOptions {
  std::uint64_t seed = 0;
  kernel::Order order = kernel::Order::fifo;
  std::string replay;      ///< the line that repeats the run, for reports
  Ranks* ranks = nullptr;  ///< of a run of several processes; must outlive the experiment
};

class Experiment {
 public:
  /// Bad input of any kind is found here, as BadInput. The scenario must outlive the experiment. With ranks, each makes
  /// one; the calls below are the leader's, and the other ranks only call follow().
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
  /// When the last task but services ended.
  std::optional<Time> last_end() const { return ranked_ ? ranked_->windows().last_end() : last_end_; }
  /// The number of events so far: with ranks, when the records were gathered.
  std::uint64_t events() const;

  /// On ranks other than the leader: follows the leader, up to the end of its experiment.
  void follow() { ranked_->follow(); }
  /// The number of processes.
  int ranks() const { return options_.ranks != nullptr ? options_.ranks->count() : 1; }
  /// True if the robot's tasks are in this process.
  bool is_here(std::size_t robot) const { return placement().is_here(robot); }
  /// Before the run, on all ranks in the same order, of several: see Freight.
  void add(Freight& freight) { ranked_->add(freight); }
  /// Before its robots' digests and events() are read: brings those of other ranks.
  void gather_records() const;

  /// Schedules an intervention: see Operator::add(). Its result appears in outcomes().
  Time intervene(Intervention intervention, std::optional<Time> date = std::nullopt);
  /// Called after each step of the world; must not change anything or throw.
  void set_observer(std::function<void(Time now)> observer) { observer_ = std::move(observer); }
  const std::function<void(Time now)>& observer() const { return observer_; }
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
  /// A line for each task (list_tasks()): the environment's, then by robot, for people.
  std::string tasks();
  /// The figures so far that expectations refer to; cheap.
  bridge::RunTotals figures() const;
  /// The result so far.
  bridge::RunResult result() const;

 private:
  void make(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types);
  void join_ranks();
  const Placement& placement() const;
  void make_network(const scenario::Scenario& scenario);
  const world::BodyState* body_of(const std::string& robot) const;
  void spawn_robots(const scenario::Scenario& scenario);
  void spawn(bridge::Robot& robot);
  std::string idle_here(Duration least);
  void complete(bridge::RobotResult& result, std::size_t robot) const;
  WorldSteps steps() const { return WorldSteps(assembly_->scenario().step); }
  void run_world();
  void find_working_sets();
  void fetch_for_step(std::size_t robot) const;
  void step_world();
  RunEnd run_to_end_of_step(Time until);

  ExperimentOptions options_;
  std::optional<io::Network> network_;  // destroyed after the robots, whose modules have sockets
  std::optional<Assembly> assembly_;
  std::vector<kernel::Robot*> lanes_;         // by robot
  std::vector<const kernel::Task*> bridges_;  // by robot; null: elsewhere
  WorkingSet step_sets_;                      // of the world's task at each robot, one after the other
  std::vector<std::size_t> step_sets_ends_;   // by robot, in that list
  std::optional<Operator> operator_;
  std::function<void(Time now)> observer_;
  Simulation simulation_;                            // destroyed before the objects that its tasks use
  RobotPrograms programs_{simulation_.scheduler()};  // destroyed before: its tasks must not be unwound
  std::unique_ptr<RankedRun> ranked_;                // of several ranks
  RunEnd end_ = RunEnd::time_reached;
  std::optional<Time> last_end_;
  bool paused_ = false;
};

}  // namespace waitpoint::run
