// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/simulation.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <ostream>
#include <system_error>

#include "core/error.hpp"
#include "core/exception_text.hpp"
#include "core/number_text.hpp"
#include "core/spin_lock.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/sync/blocking.hpp"
#include "fibers/sync/report/object_names.hpp"
#include "fibers/sync/signals.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

// Checked before the scheduler's constructor, which could report a failure only as a bug of ours.
SimulationOptions checked(SimulationOptions options) {
  WAITPOINT_REQUIRE(options.most_tasks >= 1 && options.most_tasks <= kernel::tasks_max,
                    "a run may have from 1 to 2^20 tasks at once");
  if (!kernel::Scheduler::has_address_space())
    throw std::system_error(std::make_error_code(std::errc::not_enough_memory),
                            "no address space for the run's tables (a limit such as ulimit -v)");
  return options;
}

std::string what(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::exception& exception) {
    return exception_text(exception);
  } catch (...) {
    return "an exception of unknown type";
  }
}

}  // namespace

bool are_fast_paths_enabled() {
  const char* const variable = std::getenv("WAITPOINT_FAST_PATHS");
  const std::string_view value = variable != nullptr ? variable : "";
  if (value == "0") return false;
  if (value.empty() || value == "1") return true;
  throw BadInput("WAITPOINT_FAST_PATHS", "expected 0 or 1, found '" + std::string(value) + "'");
}

std::uint64_t instant_limit_of_environment(std::uint64_t usual) {
  const char* const variable = std::getenv("WAITPOINT_INSTANT_LIMIT");
  if (variable == nullptr || *variable == '\0') return usual;
  std::uint64_t waitpoints = 0;
  if (!parse_number(variable, waitpoints) || waitpoints == 0)
    throw BadInput("WAITPOINT_INSTANT_LIMIT",
                   "expected a whole number from 1 to 2^64 - 1, found '" + std::string(variable) + "'");
  return waitpoints;
}

Simulation::Simulation(SimulationOptions options)
    : options_(checked(std::move(options))),
      scheduler_(std::make_unique<kernel::Scheduler>(options_.order, options_.seed)) {
  kernel::hooks(*scheduler_).client = static_cast<sync::RunContext*>(this);
  kernel::roster(*scheduler_).set_most_tasks(options_.most_tasks);
  if (!options_.fast_paths || !are_fast_paths_enabled()) kernel::use_fast_paths(*scheduler_, false);
  kernel::set_instant_limit(*scheduler_, instant_limit_of_environment(options_.instant_limit));
  kernel::hooks(*scheduler_).replay = options_.replay.c_str();
  kernel::hooks(*scheduler_).deliver_signals = sync::deliver_signals;
  add(environment_, "environment");
}

Simulation::~Simulation() { unwind(); }

void Simulation::restart(std::uint64_t seed) {
  options_.seed = seed;
  failure_ = nullptr;
  trouble_.clear();
  names_.clear();
  robots_.clear();
  robot_states_.clear();
  scheduler_->restart(seed);
  add(environment_, "environment");
}

kernel::Robot& Simulation::add_robot(const std::string& name) {
  WAITPOINT_REQUIRE(name.size() < kernel::name_size, "a robot's name is too long");
  kernel::Robot& robot = robots_.emplace_back();
  add(robot, name.c_str());
  WAITPOINT_REQUIRE(names_.insert(robot.name).second, "two robots of one name");
  return robot;
}

void Simulation::add(kernel::Robot& robot, const char* name) {
  kernel::add_robot(*scheduler_, robot, name);
  robot.client = &robot_states_.emplace_back();
}

void Simulation::spawn(kernel::Robot& robot, const kernel::SpawnOptions& options, std::function<void()> body) {
  sync::start_thread(*scheduler_, robot, options, sync::make_call(std::move(body)));
}

RunEnd Simulation::run_before(Time until) {
  const kernel::FaultReports reports(scheduler_.get());
  const sync::SystemCalls calls;
  const kernel::RunState state = kernel::run_before(*scheduler_, until);
  if (failure_ != nullptr) std::rethrow_exception(failure_);
  const bool was_told =
      state == kernel::RunState::stopped && kernel::stop_cause(*scheduler_) == kernel::StopCause::requested;
  if (state == kernel::RunState::reached || was_told) {
    if (!was_told && until == Time::max()) trouble_ = sync::describe_endless(*scheduler_, places_);
    return RunEnd::time_reached;
  }
  if (state == kernel::RunState::stopped && kernel::stop_cause(*scheduler_) == kernel::StopCause::ended)
    return RunEnd::ended;
  if (state == kernel::RunState::stopped && kernel::stop_cause(*scheduler_) == kernel::StopCause::no_progress) {
    trouble_ = sync::describe_spinning(*scheduler_, places_);
    return RunEnd::no_progress;
  }
  // Services that wait for each other are a deadlock, too, whichever tasks are left.
  if (kernel::roster(*scheduler_).live_tasks() == 0 && kernel::stop_cause(*scheduler_) != kernel::StopCause::deadlock)
    return RunEnd::ended;
  trouble_ = sync::describe_deadlock(*scheduler_, places_);
  return RunEnd::deadlock;
}

bool Simulation::go_on_with_services() {
  if (kernel::stop_cause(*scheduler_) != kernel::StopCause::ended) return false;
  kernel::go_on_after_end(*scheduler_);
  return true;
}

namespace {

// The std::terminate handler is the process's: the first of the threads that unwind a run sets it, the last one
// restores the previous handler.
SpinLock terminate_lock;
int terminate_users = 0;
std::atomic<std::terminate_handler> terminate_before = nullptr;

class TerminateHandler {
 public:
  explicit TerminateHandler(std::terminate_handler handler) {
    const std::lock_guard guard(terminate_lock);
    if (terminate_users++ == 0) terminate_before = std::set_terminate(handler);
  }
  ~TerminateHandler() {
    const std::lock_guard guard(terminate_lock);
    if (--terminate_users == 0) std::set_terminate(terminate_before);
  }
  TerminateHandler(const TerminateHandler&) = delete;
  TerminateHandler& operator=(const TerminateHandler&) = delete;
};

}  // namespace

void Simulation::unwind() {
  const kernel::FaultReports reports(scheduler_.get());
  const TerminateHandler handler(terminate_task);
  kernel::unwind(*scheduler_);
}

// Unwind reached a noexcept frame: a destructor in which the task waited at the end of the run.
void Simulation::terminate_task() {
  if (kernel::running != nullptr && std::current_exception() != nullptr) {
    try {
      throw;
    } catch (const sync::Unwind&) {
      kernel::abandon();
    } catch (...) {
    }
  }
  if (const std::terminate_handler before = terminate_before; before != nullptr) before();
  std::abort();
}

std::vector<std::string> Simulation::abandoned() const {
  std::vector<std::string> names;
  for (const kernel::Task* task = kernel::roster(*scheduler_).first_abandoned(); task != nullptr; task = task->next)
    names.push_back(std::string(task->name) + " of " + task->robot->name);
  return names;
}

Digest Simulation::digest() const {
  std::vector<const kernel::Robot*> in_order;
  for (const kernel::Robot& robot : robots_) in_order.push_back(&robot);
  std::sort(in_order.begin(), in_order.end(),
            [](const auto* a, const auto* b) { return std::string_view(a->name) < std::string_view(b->name); });
  Digest digest;
  for (const kernel::Robot* robot : in_order) {
    digest.add(std::string_view(robot->name));
    digest.add(robot->digest.value());
  }
  digest.add(environment_.digest.value());
  return digest;
}

void Simulation::fail(std::exception_ptr failure, const char* how) {
  if (failure_ == nullptr) {
    failure_ = std::move(failure);
    trouble_ = std::string(how) + " task " + sync::describe(*kernel::running) + " at " +
               to_string(kernel::running->local_time) + " s";
    if (const kernel::Work& work = kernel::running->work; work.what != nullptr)
      trouble_ += std::string(", in ") + work.what + " of " + work.of;
    trouble_ += ": " + what(failure_);
  }
  kernel::stop(*scheduler_, kernel::StopCause::requested);
}

std::ostream& operator<<(std::ostream& out, const Report& report) {
  if (report.passed)
    out << "passed at " << to_string(report.end_time) << " s, " << report.events << " events, "
        << to_string(report.digest);
  else
    out << report.text;
  for (const std::string& task : report.abandoned) out << "\nnot unwound, its objects leak: task " << task;
  return out;
}

namespace {

std::uint64_t seed_from(const std::string& text) {
  std::uint64_t seed = 0;
  if (!parse_number(text, seed))
    throw BadInput("WAITPOINT_SEED", "expected a whole number from 0 to 2^64 - 1, found '" + text + "'");
  return seed;
}

}  // namespace

Report simulate(std::function<void()> body, SimulationOptions options) {
  if (const char* seed = std::getenv("WAITPOINT_SEED"); seed != nullptr && *seed != '\0') {
    options.order = kernel::Order::seeded;
    options.seed = seed_from(seed);
  }
  if (options.replay.empty() && options.order == kernel::Order::seeded)
    options.replay = "WAITPOINT_SEED=" + std::to_string(options.seed) + " and the same test again";
  const std::string replay = options.replay;
  Report report;
  Simulation simulation(std::move(options));
  simulation.spawn(simulation.environment(), {.name = "main"}, std::move(body));
  try {
    report.end = simulation.run_before();
  } catch (...) {  // reported by simulation.trouble()
  }
  report.text = simulation.trouble();
  report.digest = simulation.digest();
  report.end_time = simulation.global_time();
  report.events = kernel::events(simulation.scheduler());
  simulation.unwind();
  report.abandoned = simulation.abandoned();
  report.passed = report.text.empty();
  if (!report.passed && !replay.empty()) report.text += "\nreplay: " + replay;
  return report;
}

}  // namespace waitpoint
