// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/robot.hpp"

#include <algorithm>

#include "core/doing.hpp"
#include "core/nearest_name.hpp"
#include "core/process_state.hpp"
#include "modules/bridge/derived_settings.hpp"
#include "modules/bridge/module_making.hpp"
#include "modules/control/controller.hpp"
#include "modules/control/parser.hpp"
#include "modules/executive/executive.hpp"
#include "modules/executive/goals_for_others.hpp"
#include "modules/executive/known_space.hpp"
#include "modules/executive/trajectory_follower.hpp"
#include "modules/genom/module.hpp"
#include "modules/plan/executor.hpp"
#include "modules/plan/plan_reader.hpp"
#include "modules/tcl/tcl_executive.hpp"

namespace waitpoint::bridge {
namespace {

// Adds the scenario's line to BadInput thrown by `function`.
template <class Function>
void at(const scenario::Location& written, Function&& function) {
  try {
    function();
  } catch (const BadInput& error) {
    throw written.bad(error.what());
  }
}

// The first that takes a mission carries it out.
template <class... Executives>
std::unique_ptr<executive::RobotExecutive> first_of(const executive::ExecutiveSetup& setup) {
  std::unique_ptr<executive::RobotExecutive> made;
  (void)((Executives::takes(setup) && (made = std::make_unique<Executives>(setup))) || ...);
  return made;
}

std::unique_ptr<executive::RobotExecutive> executive_of(const executive::ExecutiveSetup& setup) {
  return first_of<executive::GoalsForOthers, tcl::TclExecutive, executive::Executive, executive::TrajectoryFollower>(
      setup);
}

template <class Named>  // a script or a trajectory
std::optional<executive::MissionFile> mission_file(const std::optional<Named>& named) {
  if (!named) return std::nullopt;
  return executive::MissionFile{named->file, named->text, named->written.file, named->written.line};
}

constexpr Duration replan_period_unknown = std::chrono::milliseconds(200);

std::string report_text(const executive::GoalRecord& record) {
  switch (record.state) {
    case executive::GoalState::ahead: return "";
    case executive::GoalState::reached: return "reached";
    case executive::GoalState::no_route: return executive::to_string(record.outcome);
    default: return "the way stays blocked";
  }
}

GoalResult goal_result(Point position, const std::string& name, const executive::GoalRecord& record) {
  return {position, name, record.visits, record.times_reached, record.date, report_text(record)};
}

}  // namespace

Robot::Robot(const scenario::RobotScenario& scenario, std::span<const genom::ModuleType> types,
             std::shared_ptr<const executive::KnownSpace> known, world::World& world, world::BodyId body,
             io::Network* network, std::uint64_t seed)
    : scenario_(scenario), world_(world), body_(body), bridge_(std::in_place, scenario, world, body, names_) {
  for (const std::string& name : scenario.processors) names_.add_processor(name);
  make_modules(types, network, {known, &known->map()});
  make_executive(std::move(known), seed);
  connect();
  if (scenario.control) make_controller();
}

Robot::Robot(const scenario::RobotScenario& scenario, world::World& world, world::BodyId body)
    : scenario_(scenario), world_(world), body_(body) {}

// The executive, a client of the modules, and the controller between end before them.
Robot::~Robot() {
  controller_.reset();
  executive_.reset();
  plan_.reset();
  while (!modules_.empty()) {
    const std::string doing = "destroying module " + module_scenarios_.back()->name + " of robot " + scenario_.name;
    const Doing destruction(doing.c_str());
    const ProcessStateKept surroundings(doing.c_str());
    modules_.pop_back();
    module_scenarios_.pop_back();
  }
}

void Robot::make_modules(std::span<const genom::ModuleType> types, io::Network* network,
                         const std::shared_ptr<const OccupancyGrid>& known_map) {
  for (const scenario::ModuleScenario& module : scenario_.modules) {
    if (!module.enabled) continue;
    genom::ModuleSetup setup{names_, module.name, genom::Settings(settings_of(scenario_, module)), network, known_map};
    derive_settings(scenario_, module, setup.settings);
    modules_.push_back(make_module(module, types, scenario_.name, setup));
    module_scenarios_.push_back(&module);
  }
}

// The keys of `executive` are read for each robot, with a mission or without. With a script below a plan they are the
// script's.
void Robot::make_executive(std::shared_ptr<const executive::KnownSpace> known, std::uint64_t seed) {
  executive::ExecutiveSetup setup{.names = names_,
                                  .robot = scenario_.name,
                                  .parameters = {},
                                  .known = std::move(known),
                                  .start = {},
                                  .goals = {},
                                  .is_for_others = scenario_.goals_are_for_nodes(),
                                  .script = mission_file(scenario_.script),
                                  .trajectory = mission_file(scenario_.trajectory),
                                  .random = executive_stream(seed)};
  if (setup.script) setup.script->folders = scenario_.script->folders;
  genom::Settings settings(scenario_.executive);
  derive_outline(robot_outline(scenario_.body.shape), settings, "planning.");
  if (!setup.known->is_known()) setup.parameters.replan_ms = replan_period_unknown;
  executive::read(settings, setup.parameters);
  const genom::TaskComputing computing = genom::read_computing(settings, "", names_, {});
  settings.check_all_used();
  setup.start.pose = scenario_.body.start;
  for (const scenario::Goal& goal : scenario_.goals) setup.goals.push_back(goal.position);
  if (has_mission()) (scenario_.plan != nullptr && scenario_.script ? script_computing_ : computing_) = computing;
  if (scenario_.plan != nullptr && scenario_.script) make_procedures();
  executive_ = executive_of(setup);
  if (scenario_.plan != nullptr)
    plan_ = std::make_unique<plan::Executor>(names_, plan::read_plan(*scenario_.plan), setup.start);
}

RandomStream Robot::executive_stream(std::uint64_t seed) const { return {seed, scenario_.name, "executive"}; }

void Robot::reseed(std::uint64_t seed) {
  if (executive_ != nullptr) executive_->reseed(executive_stream(seed));
}

// The words of calls of procedures.
void Robot::check_calls() const {
  for (const plan::Action& action : plan_->plan().actions) {
    if (!action.request || !action.request->is_to_script()) continue;
    const std::vector<Setting>& input = action.request->input;
    const std::string wrong = procedures_->check(action.request->name, input.empty() ? "" : input.front().text);
    if (!wrong.empty()) throw action.request->written.bad(wrong);
  }
}

// The script below a plan as a module among the others.
void Robot::make_procedures() {
  const scenario::ScriptScenario& script = *scenario_.script;
  const tcl::Library& library = tcl::library_for(script.file, script.text, script.written.file, script.written.line);
  procedures_scenario_.name = plan::script_module;
  procedures_scenario_.written = script.written;
  genom::ModuleSetup setup{names_, procedures_scenario_.name, genom::Settings()};
  at(procedures_scenario_.written, [&] {
    auto procedures = std::make_unique<tcl::Procedures>(setup, library, script.text);
    procedures_ = procedures.get();
    modules_.push_back(std::move(procedures));
  });
  module_scenarios_.push_back(&procedures_scenario_);
}

void Robot::connect() {
  bridge_->connect();
  for (std::size_t i = 0; i < modules_.size(); ++i) at(module_scenarios_[i]->written, [&] { modules_[i]->connect(); });
  if (executive_) at(scenario_.written, [&] { executive_->connect(); });
  if (plan_) plan_->connect();
  if (procedures_ != nullptr) check_calls();
  evaluation_.connect(names_);
}

// Last: rules name the posters of modules and bridge.
void Robot::make_controller() {
  const scenario::ControlScenario& control = *scenario_.control;
  genom::Settings settings(control.settings);
  const genom::TaskComputing computing = genom::read_computing(settings, "", names_, {});
  settings.check_all_used();
  controller_ =
      std::make_unique<control::Controller>(control::parse_rules(control.rules, control.file), names_, computing);
}

void Robot::run() {
  if (controller_) controller_->start();
  for (const auto& module : modules_) module->start();
  if (has_script_below_plan()) return run_script_below_plan();
  if (executive_) executive_->run();
  if (plan_) plan_->run();
}

void Robot::run_script_below_plan() {
  threads::thread script({.name = "script",
                          .stack = kernel::StackSize::program,
                          .clock = script_computing_.clock,
                          .on = script_computing_.on,
                          .priority = script_computing_.priority},
                         [this] { executive_->run(); });
  plan_->run();
  executive_->stop();
  script.join();
}

void Robot::add_step_to(WorkingSet& set) const {
  set.add(body_);
  evaluation_.add_to(set);
  bridge_->add_step_to(set);
}

// A script below a plan goes on until the plan has ended.
void Robot::stop() {
  if (plan_)
    plan_->stop();
  else if (executive_)
    executive_->stop();
}

void Robot::end_modules() {
  genom::Client client(names_, "end of " + scenario_.name);
  for (const auto& module : modules_) {
    const bool ended = client.end_module(module->name());
    WAITPOINT_CHECK(ended, "an interrupted activity of a module does not end");
    module->join();
  }
  if (controller_) controller_->stop();
}

void Robot::set_watch(genom::ModuleWatch* watch) {
  watch_ = watch;
  for (const auto& module : modules_) module->set_watch(watch);
}

void Robot::keep_paths() {
  WAITPOINT_CHECK(!kept_paths_, "a robot's paths are kept twice");
  add_path_sink(kept_paths_.emplace());
}

std::string Robot::plan_text() const {
  if (plan_ == nullptr) return "";
  return name() + ": plan '" + plan_->plan().name + "': " + to_string(plan_->checked());
}

std::uint64_t Robot::goals() const {
  std::uint64_t count = goals_elsewhere_;
  if (executive_)
    for (const executive::GoalRecord& goal : executive_->goals()) count += goal.visits;
  return count;
}

std::uint64_t Robot::goals_reached() const {
  std::uint64_t count = reached_elsewhere_;
  if (executive_)
    for (const executive::GoalRecord& goal : executive_->goals()) count += goal.times_reached;
  return count;
}

std::optional<std::size_t> Robot::current_goal() const {
  if (!executive_ || executive_->current_goal() >= executive_->goals().size()) return std::nullopt;
  return executive_->current_goal();
}

bool Robot::end_goal(bool is_reached) {
  return executive_ != nullptr &&
         executive_->end_goal(is_reached ? executive::GoalState::reached : executive::GoalState::given_up);
}

void Robot::set_goals(std::uint64_t goals, std::uint64_t reached) {
  goals_elsewhere_ = goals;
  reached_elsewhere_ = reached;
}

std::optional<Duration> Robot::least_period() const {
  std::optional<Duration> least;
  for (const auto& module : modules_)
    for (const genom::ExecutionTask& task : module->tasks())
      if (task.periodic() && (!least || task.options().period_ms < *least)) least = task.options().period_ms;
  return least;
}

RobotResult Robot::result() const {
  RobotResult result;
  result.name = scenario_.name;
  result.shape = scenario_.body.shape;
  if (presence() == Presence::elsewhere) return result;
  for (std::size_t i = 0; executive_ && i < scenario_.goals.size(); ++i)
    result.goals.push_back(goal_result(scenario_.goals[i].position, scenario_.goals[i].name, executive_->goals()[i]));
  if (scenario_.trajectory) {
    const executive::GoalRecord& end = executive_->goals().front();
    result.goals.push_back(goal_result(end.goal, "end of the trajectory", end));
  }
  if (plan_) result.plan = PlanResult{plan_->plan().name, plan_->completed(), plan_->end(), plan_->log()};
  const world::BodyState& body = world_.body(body_);
  result.collisions = body.collisions;
  result.distance_m = body.travelled_m;
  result.present.motion =
      scenario_.nodes.has_value() || std::any_of(scenario_.bridge.begin(), scenario_.bridge.end(),
                                                 [](const auto& row) { return row.device.starts_with("base."); });
  if (scenario_.body.sensors<world::Battery>()) {
    world::Battery::Reading battery;
    world_.read<world::Battery>(body_, 0, battery);
    result.battery = {.charge = battery.charge, .volts = battery.volts};
    if (battery.empty) result.battery->empty_at = Time() + battery.empty_after;
  }
  evaluation_.write(result);
  if (kept_paths_) {
    result.true_path = kept_paths_->samples(PathKind::truth);
    result.estimated_path = kept_paths_->samples(PathKind::estimate);
    result.odometry_path = kept_paths_->samples(PathKind::odometry);
  }
  for (const auto& module : modules_)
    for (const genom::ExecutionTask& task : module->tasks())
      if (task.missed_deadlines() > 0)
        result.late_tasks.push_back({module->name() + "." + task.name(), task.options().period_ms,
                                     task.missed_deadlines(), task.missed_periods(), task.greatest_lateness()});
  const auto* map = dynamic_cast<const genom::Poster<posters::SegmentMap>*>(names_.find_poster("segloc.map"));
  if (const auto segments = map != nullptr ? map->look() : std::nullopt)
    for (const posters::MapSegment& segment : segments->items) result.segments.push_back({segment.start, segment.end});
  return result;
}

std::size_t index_of(std::string_view name, const std::vector<std::unique_ptr<Robot>>& robots,
                     const scenario::Location& written) {
  std::vector<std::string_view> known;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (robots[i]->name() == name) return i;
    known.push_back(robots[i]->name());
  }
  throw written.bad("there is no robot '" + std::string(name) + "'" + did_you_mean(name, known));
}

}  // namespace waitpoint::bridge
