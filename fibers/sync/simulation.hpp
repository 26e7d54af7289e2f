// SPDX-License-Identifier: BSD-3-Clause
// A run: the tasks of some robots, from virtual time 0 until no task remains, a given time, or a failure.
//
//   waitpoint::Report report = waitpoint::simulate([] { /* threads, mutexes, sleeps, in virtual time */ });
//   EXPECT_TRUE(report.passed) << report;
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <iosfwd>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/digest.hpp"
#include "core/time.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/spawn_options.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/sync/report/blocked_report.hpp"
#include "fibers/sync/robot_state.hpp"
#include "fibers/sync/run_context.hpp"

namespace waitpoint {

inline constexpr std::chrono::sys_days default_start_date{std::chrono::year(2000) / std::chrono::January / 1};

struct SimulationOptions {
  kernel::Order order = kernel::Order::fifo;
  std::uint64_t seed = 0;
  std::string replay;  ///< the replay line, for reports
  /// The date of system_clock at virtual time 0: a declared constant, never the machine's date.
  std::chrono::sys_time<std::chrono::nanoseconds> start_date = default_start_date;
  unsigned hardware_concurrency = 4;  ///< the number reported to threads; each has a processor of its own nevertheless
  /// The greatest number of simultaneous threads, from 1 to kernel::tasks_max: one more is a std::system_error.
  std::uint32_t most_tasks = kernel::tasks_max;
  /// The number of waitpoints at one instant of virtual time after which the run ends with no progress although its
  /// tasks exchange something. WAITPOINT_INSTANT_LIMIT in the environment replaces it in every simulation.
  std::uint64_t instant_limit = kernel::instant_limit;
  /// If false, each event takes the kernel's plain path: for comparison, since the run is the same.
  /// WAITPOINT_FAST_PATHS=0 in the environment sets it to false in every simulation.
  bool fast_paths = true;
};

/// False if WAITPOINT_FAST_PATHS=0 is in the environment, true if it is 1 or not there; else BadInput.
bool are_fast_paths_enabled();

/// WAITPOINT_INSTANT_LIMIT of the environment, or `usual` without it; BadInput if it is no positive number.
std::uint64_t instant_limit_of_environment(std::uint64_t usual);

/// The reason why run_before() returned.
enum class RunEnd : std::uint8_t {
  time_reached,  ///< or stopped from outside
  ended,         ///< no task remains but services
  deadlock,      ///< a cycle of waiting tasks, or none can run again
  no_progress,   ///< tasks spin without progress of virtual time
};

class Simulation final : public sync::RunContext {
 public:
  /// Throws std::system_error if the address space of a run cannot be reserved.
  explicit Simulation(SimulationOptions options = {});
  /// Unwinds the remaining tasks.
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// After unwind(): resets to the state of a new simulation with the same options and a new seed; added robots are
  /// removed. For many short runs: it takes a microsecond, since memory is kept.
  void restart(std::uint64_t seed);

  /// The pseudo-robot of tasks that belong to no robot.
  kernel::Robot& environment() { return environment_; }
  const kernel::Robot& environment() const { return environment_; }
  /// `name` must be unique.
  kernel::Robot& add_robot(const std::string& name);

  /// Creates a task that starts at virtual time 0, or now if the run has begun. Only from outside tasks. Throws
  /// std::system_error if no more tasks can be created.
  void spawn(kernel::Robot& robot, const kernel::SpawnOptions& options, std::function<void()> body);

  /// Executes all events before `until`; may be called again with a later time. An exception that escaped from a task
  /// is rethrown here, and at every later call.
  RunEnd run_before(Time until = Time::max());

  /// After RunEnd::ended: the next run_before() executes the events of the services that remain. False if none has any.
  bool go_on_with_services();

  /// The report of run_before()'s failure: a deadlock, a lack of progress, tasks that sleep without end, or an
  /// exception with its task and time. Empty if there was none.
  const std::string& trouble() const { return trouble_; }
  /// Controls the source locations in trouble(), on by default: off for callers with many failures.
  void tell(sync::Places places) { places_ = places; }

  /// Ends all remaining tasks. Nothing can be run afterwards.
  void unwind();
  /// After unwind(): the tasks that could not be unwound, "name of robot" each; objects in their frames leak. They
  /// waited in a destructor, or catch Unwind in a loop.
  std::vector<std::string> abandoned() const;

  /// Combines the robots' digests in the order of their names, then the environment's.
  Digest digest() const;
  const SimulationOptions& options() const { return options_; }
  Time global_time() const { return kernel::global_time(*scheduler_); }
  kernel::Scheduler& scheduler() { return *scheduler_; }
  const kernel::Scheduler& scheduler() const { return *scheduler_; }

  static Simulation& of(kernel::Scheduler& scheduler) { return static_cast<Simulation&>(RunContext::of(scheduler)); }
  std::chrono::sys_time<std::chrono::nanoseconds> start_date() const override { return options_.start_date; }
  unsigned hardware_concurrency() const override { return options_.hardware_concurrency; }
  /// From within a task: ends the run with an exception. `how` and the task's name begin its report in trouble().
  void fail(std::exception_ptr failure, const char* how = "an exception escaped from") override;

 private:
  SimulationOptions options_;
  std::unique_ptr<kernel::Scheduler> scheduler_;
  kernel::Robot environment_;
  std::deque<kernel::Robot> robots_;
  std::set<std::string_view> names_;            // the robots' names
  std::deque<sync::RobotStates> robot_states_;  // of the environment, then of the robots
  static void terminate_task();
  void add(kernel::Robot& robot, const char* name);

  std::exception_ptr failure_;
  std::string trouble_;
  sync::Places places_ = sync::Places::told;
};

/// The result of one simulated run of a test body.
struct Report {
  bool passed = false;
  RunEnd end = RunEnd::ended;
  std::string text;  ///< the failure and how to replay it; empty if it passed
  Digest digest;
  Time end_time;
  std::uint64_t events = 0;
  std::vector<std::string> abandoned;  ///< see Simulation::abandoned
};

std::ostream& operator<<(std::ostream& out, const Report& report);

/// Runs `body` as the first task of a new run, until no task remains but services. An exception that escapes from a
/// task is a failure of the report. WAITPOINT_SEED in the environment selects that seed's order instead of that of
/// `options`; BadInput if it is not a number.
Report simulate(std::function<void()> body, SimulationOptions options = {});

}  // namespace waitpoint
