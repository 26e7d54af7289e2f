// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/experiment.hpp"

#include <algorithm>
#include <string>
#include <system_error>

#include "core/error.hpp"
#include "fibers/sync/blocked_report.hpp"
#include "fibers/sync/thread.hpp"
#include "fibers/sync/threads.hpp"
#include "modules/run/heap_pages.hpp"

namespace waitpoint::run {
namespace {

// Number of robots from which huge pages pay: the TLB does not hold the small pages of more.
constexpr std::size_t crowd = 200;

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
  scheduler.set_decisions(usual);
}

/// Evaluates a pause condition after each event, in addition to the present watch.
class PauseWatch : private kernel::Watch {
 public:
  PauseWatch(kernel::Scheduler& scheduler, const std::function<bool(const kernel::EventRecord&)>& enough)
      : Watch{&PauseWatch::see}, scheduler_(scheduler), other_(scheduler.watch()), enough_(enough) {
    scheduler_.set_watch(this);
  }
  ~PauseWatch() { scheduler_.set_watch(other_); }
  PauseWatch(const PauseWatch&) = delete;
  PauseWatch& operator=(const PauseWatch&) = delete;

  bool paused() const { return paused_; }

 private:
  static void see(kernel::Watch& watch, const kernel::EventRecord& record) {
    PauseWatch& self = static_cast<PauseWatch&>(watch);
    if (self.other_ != nullptr) self.other_->event(*self.other_, record);
    if (self.paused_ || !self.enough_(record)) return;
    self.paused_ = true;
    self.scheduler_.pause();
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
  make_network(scenario);
  assembly_.emplace(scenario, types, &*network_, options.seed);
  operator_.emplace(assembly_->world(), robots(), lanes_);
  simulation_.spawn(
      simulation_.environment(),
      {.name = "world", .stack = kernel::StackSize::large, .phase = kernel::Phase::world, .service = true},
      [this] { run_world(); });
  spawn_robots(scenario);
  if (scenario.medium) programs_.set_network(*network_);
  for (std::size_t i = 0; i < lanes_.size(); ++i)
    for (const scenario::ProgramScenario& program : scenario.robots[i].programs) programs_.add(program, *lanes_[i]);
  if (robots().size() >= crowd) put_heap_on_large_pages();
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

// A robot with goals keeps the run alive until its executive ends; one without does not.
void Experiment::spawn(bridge::Robot& robot) {
  kernel::Robot& lane = simulation_.add_robot(robot.name());
  lanes_.push_back(&lane);
  simulation_.spawn(lane, {.name = "bridge", .phase = kernel::Phase::world, .service = true},
                    [&robot] { robot.bridge().run(); });
  const genom::TaskComputing& computing = robot.computing();
  // Planning needs a large stack, of which there are 16 384; crowds of more have no goals.
  const kernel::StackSize stack = robot.has_goals() ? kernel::StackSize::large : kernel::StackSize::medium;
  sync::start_thread(simulation_.scheduler(), lane,
                     {.name = "executive", .stack = stack, .service = !robot.has_goals()},
                     sync::make_call([&robot] { robot.run(); }), {computing.clock, computing.on, computing.priority});
}

void Experiment::run_world() {
  for (std::int64_t k = 1;; ++k) {
    this_thread::sleep_until(Time() + assembly_->scenario().step * k);
    operator_->act(now());
    assembly_->world().step();
    for (const world::LooseState& loose : world().loose()) threads::record(loose_state, loose);
    constexpr std::size_t ahead = 6;  // a crowd does not fit into the cache
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      if (i + ahead < lanes_.size()) robots()[i + ahead]->fetch_evaluation();
      if (!lanes_[i]->ended) robots()[i]->observe(now());
      robots()[i]->bridge().stepped();
    }
    if (observer_) observer_(now());
  }
}

RunEnd Experiment::run_before(Time until) {
  paused_ = false;
  try {
    end_ = simulation_.run_before(until);
  } catch (const BadInput&) {
    throw;
  } catch (...) {
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
  const Duration step = assembly_->scenario().step;
  const Time next = Time() + step * static_cast<std::int64_t>(world().steps() + 1);
  if (date && *date < next)
    throw intervention.written.bad("expected a time from " + to_string(next) + " s on, the world's next step, found " +
                                   to_string(*date) + " s");
  const std::int64_t steps = date ? (date->since_start() + step - Duration::from_ns(1)) / step : 0;
  const Time at = date ? Time() + step * steps : next;
  operator_->add(at, std::move(intervention));
  return at;
}

std::string Experiment::idle(Duration least) {
  const Duration run = simulation_.global_time().since_start();
  if (run < least) return "";
  return sync::describe_idle(simulation_.scheduler(), Time() + (run - least), sync::Places::told);
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

bridge::RunResult Experiment::result() const {
  bridge::RunResult result = assembly_->result();
  result.seed = options_.seed;
  result.digest = simulation_.digest();
  result.environment_digest = simulation_.environment().digest.digest();
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    bridge::RobotResult& robot = result.robots[i];
    robot.digest = lanes_[i]->digest.digest();
    const std::vector<std::optional<int>> statuses = programs_.exit_statuses(*lanes_[i]);
    for (std::size_t k = 0; k < statuses.size(); ++k)
      robot.programs.push_back({assembly_->scenario().robots[i].programs[k].name, statuses[k]});
  }
  result.events = simulation_.scheduler().events();
  result.trouble = simulation_.trouble();
  result.outcome = outcome_of(end_);
  return result;
}

}  // namespace waitpoint::run
