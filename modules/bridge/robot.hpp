// SPDX-License-Identifier: BSD-3-Clause
// One robot: its modules, its bridge to the world and its executive, in a name space of its own.
//
// Its tasks are made by the run: an Experiment or a ThreadedExperiment.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "core/random.hpp"
#include "modules/bridge/evaluation.hpp"
#include "modules/bridge/kept_paths.hpp"
#include "modules/bridge/robot_bridge.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/genom/module_type.hpp"
#include "modules/genom/task_computing.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/world.hpp"

namespace waitpoint::control {
class Controller;
}  // namespace waitpoint::control
namespace waitpoint::executive {
class KnownSpace;
class RobotExecutive;
}  // namespace waitpoint::executive
namespace waitpoint::plan {
class Executor;
}  // namespace waitpoint::plan
namespace waitpoint::genom {
class ModuleWatch;
}  // namespace waitpoint::genom
namespace waitpoint::tcl {
class Procedures;
}  // namespace waitpoint::tcl

namespace waitpoint::io {
class Network;
}  // namespace waitpoint::io

namespace waitpoint::bridge {

/// Where a robot's software is: in this process, or in another one of the run (modules/run/ranks).
enum class Presence : std::uint8_t { here, elsewhere };

class Robot {
 public:
  /// Makes and connects all parts. Inconsistencies are BadInput with the scenario's line. The scenario, the world and
  /// the network (null without one) must outlive the robot.
  Robot(const scenario::RobotScenario& scenario, std::span<const genom::ModuleType> types,
        std::shared_ptr<const executive::KnownSpace> known, world::World& world, world::BodyId body,
        io::Network* network, std::uint64_t seed);
  /// A robot whose software is elsewhere: it has a name, a body, and the goals that are set.
  Robot(const scenario::RobotScenario& scenario, world::World& world, world::BodyId body);
  ~Robot();

  /// The body of the robot's main task: starts the modules, then drives the rounds of goals or executes the plan, if
  /// any.
  void run();
  /// Called from another task: aborts the rounds and stops the robot.
  void stop();
  /// After run(), from a task: ends the modules. A module that does not end is a bug.
  void end_modules();

  /// Reports the modules' activity to `watch`, which must outlive the robot's tasks. Before run(). Null: no watch.
  void set_watch(genom::ModuleWatch* watch);
  genom::ModuleWatch* watch() const { return watch_; }

  /// The execution control; null without rules.
  control::Controller* controller() const { return controller_.get(); }

  Presence presence() const { return bridge_ ? Presence::here : Presence::elsewhere; }
  /// Of a robot that is here.
  RobotBridge& bridge() { return *bridge_; }
  /// Compares the robot's estimates with the true state. Call after a step of the world.
  void observe(Time now) { evaluation_.observe(now, world_.body(body_)); }

  /// Of a robot that is here: adds the memory that observe() and the bridge's stepped() touch.
  void add_step_to(WorkingSet& set) const;

  /// Before the run: `sink`, which must outlive it, receives the robot's paths.
  void add_path_sink(PathSink& sink) { evaluation_.add_path_sink(sink); }
  /// Before the run: the paths will be in the result.
  void keep_paths();

  /// Draws from now on as with this seed; from another task.
  void reseed(std::uint64_t seed);

  double position_error_max_m() const { return evaluation_.position_error_max_m(); }

  const std::string& name() const { return scenario_.name; }
  genom::NameSpace& names() { return names_; }
  const genom::NameSpace& names() const { return names_; }
  /// True if run() ends by itself: after the rounds of goals, the script, the plan or the trajectory.
  bool has_mission() const {
    return !scenario_.goals.empty() || scenario_.script || scenario_.plan != nullptr || scenario_.trajectory;
  }
  bool has_script() const { return scenario_.script.has_value(); }
  /// "ada: plan 'round': 9 time points, 14 constraints: consistent, ..."; empty without a plan, or elsewhere.
  std::string plan_text() const;
  /// Visits to goals: those of all rounds, or in rounds without end those that have ended.
  std::uint64_t goals() const;
  std::uint64_t goals_reached() const;
  /// Index of the goal that the executive is on its way to; nothing if there is none.
  std::optional<std::size_t> current_goal() const;
  /// Ends the present goal of a robot whose nodes drive it; false if there is none.
  bool end_goal(bool is_reached);
  /// Of a robot that is elsewhere.
  void set_goals(std::uint64_t goals, std::uint64_t reached);
  /// Name, clock and processor of the task of run().
  const char* task_name() const { return plan_ != nullptr ? "plan" : "executive"; }
  const genom::TaskComputing& computing() const { return computing_; }
  /// The shortest period of all execution tasks; nothing if all are aperiodic.
  std::optional<Duration> least_period() const;
  /// The result without the digest, which the run adds.
  RobotResult result() const;

 private:
  void make_modules(std::span<const genom::ModuleType> types, io::Network* network,
                    const std::shared_ptr<const OccupancyGrid>& known_map);
  void make_executive(std::shared_ptr<const executive::KnownSpace> known, std::uint64_t seed);
  RandomStream executive_stream(std::uint64_t seed) const;
  bool has_script_below_plan() const { return plan_ != nullptr && executive_ != nullptr; }
  void make_procedures();
  void check_calls() const;
  void run_script_below_plan();
  void connect();
  void make_controller();

  const scenario::RobotScenario& scenario_;
  world::World& world_;
  world::BodyId body_;
  genom::NameSpace names_;
  std::vector<std::unique_ptr<genom::Module>> modules_;
  std::vector<const scenario::ModuleScenario*> module_scenarios_;  // by module
  genom::ModuleWatch* watch_ = nullptr;
  std::optional<RobotBridge> bridge_;             // none: it is elsewhere
  scenario::ModuleScenario procedures_scenario_;  // of the module that the script is below a plan
  genom::TaskComputing computing_;
  genom::TaskComputing script_computing_;                 // of a script below a plan
  tcl::Procedures* procedures_ = nullptr;                 // of a script below a plan
  std::unique_ptr<executive::RobotExecutive> executive_;  // null without goals, script and trajectory
  std::unique_ptr<control::Controller> controller_;       // null without rules
  std::unique_ptr<plan::Executor> plan_;                  // null without a plan
  Evaluation evaluation_;
  std::optional<KeptPaths> kept_paths_;
  std::uint64_t goals_elsewhere_ = 0, reached_elsewhere_ = 0;
};

/// The index of the robot named `name`; BadInput at `written` if there is none.
std::size_t index_of(std::string_view name, const std::vector<std::unique_ptr<Robot>>& robots,
                     const scenario::Location& written);

}  // namespace waitpoint::bridge
