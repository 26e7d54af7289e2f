// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/experiment.hpp"

#include <algorithm>
#include <string>
#include <system_error>

#include "core/error.hpp"
#include "fibers/kernel/fetch_ahead.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/watch.hpp"
#include "fibers/sync/report/blocked_report.hpp"
#include "fibers/sync/thread.hpp"
#include "fibers/sync/threads.hpp"
#include "modules/run/heap_pages.hpp"
#include "modules/run/ranks/processor_time.hpp"
#include "modules/run/task_list.hpp"

namespace waitpoint::run {
namespace {

// Number of robots from which huge pages pay: the TLB does not hold the small pages of more, half a megabyte each.
constexpr std::size_t crowd = 50, robot_bytes = std::size_t{512} << 10;

bridge::Outcome outcome_of(RunEnd end) {
  switch (end) {
    case RunEnd::time_reached: return bridge::Outcome::time_limit;
    case RunEnd::ended: return bridge::Outcome::finished;
    case RunEnd::deadlock: return bridge::Outcome::deadlock;
    case RunEnd::no_progress: return bridge::Outcome::no_progress;
  }
  return bridge::Outcome::time_limit;
}

}  // namespace

namespace {

constexpr std::uint64_t loose_state = 0x6C6F6F7365;  // "loose"

/// The strategy of the explored order until another one is set.
class FirstInFirstOut final : public kernel::Decisions {
  std::uint32_t next(kernel::Task* const*, std::uint32_t) override { return 0; }
  std::uint32_t among(kernel::Choice, const kernel::Task&, std::uint32_t) override { return 0; }
  Duration computing(const kernel::Task&, Duration, Duration greatest) override { return greatest; }
};

void decide_in_the_explored_order(kernel::Scheduler& scheduler) {
  static FirstInFirstOut usual;  // stateless
  kernel::set_decisions(scheduler, usual);
}

/// Evaluates a pause condition after each event, in addition to the present watch.
class PauseWatch : private kernel::Watch {
 public:
  PauseWatch(kernel::Scheduler& scheduler, const std::function<bool(const kernel::EventRecord&)>& enough)
      : Watch{&PauseWatch::see}, scheduler_(scheduler), other_(kernel::watch(scheduler)), enough_(enough) {
    kernel::set_watch(scheduler_, this);
  }
  ~PauseWatch() { kernel::set_watch(scheduler_, other_); }
  PauseWatch(const PauseWatch&) = delete;
  PauseWatch& operator=(const PauseWatch&) = delete;

  bool paused() const { return paused_; }

 private:
  static void see(kernel::Watch& watch, const kernel::EventRecord& record) {
    PauseWatch& self = static_cast<PauseWatch&>(watch);
    if (self.other_ != nullptr) self.other_->event(*self.other_, record);
    if (self.paused_ || !self.enough_(record)) return;
    self.paused_ = true;
    kernel::pause(self.scheduler_);
  }

  kernel::Scheduler& scheduler_;
  kernel::Watch* other_;
  const std::function<bool(const kernel::EventRecord&)>& enough_;
  bool paused_ = false;
};

}  // namespace

Experiment::Experiment(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types,
                       const ExperimentOptions& options)
    : options_(options), simulation_({options.order, options.seed, options.replay}) {
  if (options.order == kernel::Order::explored) decide_in_the_explored_order(simulation_.scheduler());
  if (options.ranks == nullptr) {
    make(scenario, types);
    return;
  }
  if (options.order == kernel::Order::explored)
    throw BadInput("--ranks",
                   "expected fifo or seeded order, found explored order: a strategy chooses for one process");
  options.ranks->act_together([&] { make(scenario, types); });
  join_ranks();
}

void Experiment::make(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types) {
  const std::size_t robots_here = scenario.robots.size() / static_cast<std::size_t>(ranks());
  if (robots_here >= crowd) grow_heap_on_large_pages(robots_here * robot_bytes);
  make_network(scenario);
  assembly_.emplace(scenario, types, &*network_, options_.seed, placement());
  operator_.emplace(assembly_->world(), *network_, robots(), lanes_);
  simulation_.spawn(
      simulation_.environment(),
      {.name = "world", .stack = kernel::StackSize::large, .phase = kernel::Phase::world, .service = true},
      [this] { run_world(); });
  spawn_robots(scenario);
  if (scenario.medium) programs_.set_network(*network_);
  for (std::size_t i = 0; i < lanes_.size(); ++i)
    for (const scenario::ProgramScenario& program : scenario.robots[i].programs)
      if (is_here(i)) programs_.add(program, *lanes_[i]);
  if (robots_here >= crowd) put_heap_on_large_pages();
}

void Experiment::join_ranks() {
  ranked_ = std::make_unique<RankedRun>(
      *options_.ranks, RankedParts{simulation_, assembly_->world(), robots(), lanes_, *operator_, *network_, steps()});
  ranked_->add_intervention = [this](const Intervention& intervention, std::optional<Time> date) {
    return operator_->add(intervention, date);
  };
  ranked_->describe_idle = [this](Duration least) { return idle_here(least); };
  ranked_->list_tasks = [this](const kernel::Robot& robot) { return list_tasks(simulation_.scheduler(), robot); };
  ranked_->result_of = [this](std::size_t robot) {
    bridge::RobotResult result = robots()[robot]->result();
    complete(result, robot);
    return result;
  };
}

const Placement& Experiment::placement() const {
  static const Placement all_here;
  return options_.ranks != nullptr ? options_.ranks->placement() : all_here;
}

void Experiment::unwind() {
  programs_.take_away();
  simulation_.unwind();
}

// Distances are between true positions at the last step of the world.
void Experiment::make_network(const scenario::Scenario& scenario) {
  network_.emplace(simulation_);
  if (scenario.medium) network_->declare(*scenario.medium);
  network_->set_distance([this](const std::string& from, const std::string& to) {
    const world::BodyState* const a = body_of(from);
    const world::BodyState* const b = body_of(to);
    // The environment's tasks have no position.
    if (a == nullptr || b == nullptr) return 0.0;
    const double over = length(b->pose.position() - a->pose.position()), higher = b->height_m - a->height_m;
    return higher == 0 ? over : exact::hypot(over, higher);
  });
}

const world::BodyState* Experiment::body_of(const std::string& robot) const {
  for (std::size_t i = 0; i < robots().size(); ++i)
    if (robots()[i]->name() == robot) return &world().body(world::BodyId(i));
  return nullptr;
}

void Experiment::spawn_robots(const scenario::Scenario& scenario) {
  for (std::size_t i = 0; i < robots().size(); ++i) {
    try {
      spawn(*robots()[i]);
    } catch (const std::system_error& full) {
      throw scenario.robots[i].start_written.bad("expected at most " + std::to_string(i) +
                                                 " such robots: " + full.what());
    }
  }
}

// A robot with a mission keeps the run alive until its executive or plan ends; one without does not.
void Experiment::spawn(bridge::Robot& robot) {
  kernel::Robot& lane = simulation_.add_robot(robot.name());
  lanes_.push_back(&lane);
  bridges_.push_back(nullptr);
  if (robot.presence() == bridge::Presence::elsewhere) return;
  simulation_.spawn(lane, {.name = "bridge", .phase = kernel::Phase::world, .service = true},
                    [&robot] { robot.bridge().run(); });
  bridges_.back() = kernel::roster(simulation_.scheduler()).last_task();
  const genom::TaskComputing& computing = robot.computing();
  // Planning needs a large stack, of which there are 16 384; crowds of more have no mission. A script that recurses to
  // Tcl's bound on its levels needs more.
  const kernel::StackSize stack = robot.has_script()    ? kernel::StackSize::program
                                  : robot.has_mission() ? kernel::StackSize::large
                                                        : kernel::StackSize::medium;
  sync::start_thread(simulation_.scheduler(), lane,
                     {.name = robot.task_name(), .stack = stack, .service = !robot.has_mission()},
                     sync::make_call([&robot] { robot.run(); }), {computing.clock, computing.on, computing.priority});
}

void Experiment::step_world() {
  if (ranked_ == nullptr) return assembly_->world().step();
  const double begin_s = processor_s();
  assembly_->world().step();
  ranked_->windows().add_world_time(processor_s() - begin_s);
}

// The memory of each robot that the world's task touches after a step: a crowd does not fit into the cache.
void Experiment::find_working_sets() {
  for (std::size_t i = 0; i < robots().size(); ++i) {
    if (bridges_[i] != nullptr) {
      robots()[i]->add_step_to(step_sets_);
      step_sets_.add(bridges_[i], kernel::record_lines_fetched * CacheLines::bytes);
    }
    step_sets_ends_.push_back(step_sets_.lines().size());
  }
}

void Experiment::fetch_for_step(std::size_t robot) const {
  if (robot >= step_sets_ends_.size()) return;
  for (std::size_t i = robot > 0 ? step_sets_ends_[robot - 1] : 0; i < step_sets_ends_[robot]; ++i)
    kernel::fetch_lines(step_sets_.lines()[i]);
}

void Experiment::run_world() {
  find_working_sets();
  for (std::int64_t k = 1;; ++k) {
    this_thread::sleep_until(Time() + assembly_->scenario().step * k);
    operator_->act(now());
    step_world();
    for (const world::LooseState& loose : world().loose()) threads::record(loose_state, loose);
    constexpr std::size_t ahead = 4;
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      // A release for each robot is no loop that polls: the task does not yield to the bridges that it has woken, which
      // are others on each rank.
      kernel::running->waitpoints = 0;
      if (!is_here(i)) {
        ranked_->windows().step(i);
        continue;
      }
      fetch_for_step(i + ahead);
      if (!lanes_[i]->ended) robots()[i]->observe(now());
      robots()[i]->bridge().stepped();
    }
    if (observer_) observer_(now());
  }
}

RunEnd Experiment::run_to_end_of_step(Time until) {
  for (;;) {
    const Time stop = last_end_ ? steps().next(*last_end_) : Time::max();
    const RunEnd end = simulation_.run_before(std::min(until, stop));
    if (end == RunEnd::ended && simulation_.go_on_with_services()) {
      last_end_ = simulation_.global_time();
      continue;
    }
    const bool is_at_stop = last_end_ && kernel::next_event_time(simulation_.scheduler()) >= stop;
    if (end != RunEnd::time_reached || !is_at_stop) return end;
    if (kernel::roster(simulation_.scheduler()).live_tasks() == 0) return RunEnd::ended;
    last_end_.reset();  // a service has made another task
  }
}

RunEnd Experiment::run_before(Time until) {
  paused_ = false;
  if (end_ == RunEnd::ended) return end_;
  try {
    if (ranked_ != nullptr)
      end_ = ranked_->run_before(until);
    else
      end_ = options_.order == kernel::Order::explored ? simulation_.run_before(until) : run_to_end_of_step(until);
  } catch (const BadInput&) {
    throw;
  } catch (...) {
    if (ranked_) throw;
    throw std::runtime_error(simulation_.trouble());
  }
  return end_;
}

RunEnd Experiment::run_before(Time until, const std::function<bool(const kernel::EventRecord&)>& enough) {
  kernel::Scheduler& scheduler = simulation_.scheduler();
  PauseWatch watch(scheduler, enough);
  const RunEnd end = run_before(until);
  paused_ = watch.paused() && end == RunEnd::time_reached;
  return end;
}

Time Experiment::intervene(Intervention intervention, std::optional<Time> date) {
  return ranked_ ? ranked_->intervene(intervention, date) : operator_->add(std::move(intervention), date);
}

std::string Experiment::idle(Duration least) { return ranked_ ? ranked_->idle(least) : idle_here(least); }

std::string Experiment::idle_here(Duration least) {
  const Duration run = simulation_.global_time().since_start();
  if (run < least) return "";
  return sync::describe_idle(simulation_.scheduler(), Time() + (run - least), sync::Places::told);
}

std::string Experiment::tasks() {
  if (ranked_) return ranked_->tasks();
  std::string lines = list_tasks(simulation_.scheduler(), simulation_.environment());
  for (const kernel::Robot* lane : lanes_) lines += list_tasks(simulation_.scheduler(), *lane);
  return lines;
}

void Experiment::gather_records() const {
  if (ranked_) ranked_->gather_records();
}

std::uint64_t Experiment::events() const {
  return kernel::events(simulation_.scheduler()) + (ranked_ ? ranked_->events_after_ends_elsewhere() : 0);
}

bridge::RunTotals Experiment::figures() const {
  bridge::RunTotals sum;
  sum.goals = goals();
  sum.goals_reached = goals_reached();
  for (std::size_t i = 0; i < robots().size(); ++i) {
    sum.collisions += world().body(world::BodyId(i)).collisions;
    sum.position_error_max_m = std::max(sum.position_error_max_m, robots()[i]->position_error_max_m());
  }
  return sum;
}

void Experiment::complete(bridge::RobotResult& result, std::size_t robot) const {
  result.digest = lanes_[robot]->digest.digest();
  const std::vector<std::optional<int>> statuses = programs_.exit_statuses(*lanes_[robot]);
  for (std::size_t i = 0; i < statuses.size(); ++i)
    result.programs.push_back({assembly_->scenario().robots[robot].programs[i].name, statuses[i]});
}

bridge::RunResult Experiment::result() const {
  gather_records();
  bridge::RunResult result = assembly_->result();
  result.seed = options_.seed;
  result.digest = simulation_.digest();
  result.environment_digest = simulation_.environment().digest.digest();
  for (std::size_t i = 0; i < lanes_.size(); ++i) complete(result.robots[i], i);
  if (ranked_) ranked_->complete(result);
  for (std::size_t i = 0; i < lanes_.size(); ++i) result.robots[i].external = operator_->external_figures(i);
  result.events = events();
  result.trouble = ranked_ ? ranked_->windows().trouble() : simulation_.trouble();
  const bool is_at_limit_after_end = last_end() && end_ == RunEnd::time_reached;
  result.outcome = outcome_of(is_at_limit_after_end ? RunEnd::ended : end_);
  return result;
}

}  // namespace waitpoint::run
