// SPDX-License-Identifier: BSD-3-Clause
// A run: the tasks of some robots, from virtual time 0 until no task remains, or a time, or a failure.
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
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/digest.hpp"
#include "core/time.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/sync/blocked_report.hpp"
#include "fibers/sync/robot_state.hpp"
#include "fibers/sync/run_context.hpp"

namespace waitpoint {

inline constexpr std::chrono::sys_days default_start_date{std::chrono::year(2000) / std::chrono::January / 1};

struct SimulationOptions {
  kernel::Order order = kernel::Order::fifo;
  std::uint64_t seed = 0;
  std::string replay;  ///< the line that repeats this run, for reports
  /// What system_clock shows at virtual time 0: a declared constant, never the date of the machine.
  std::chrono::sys_time<std::chrono::nanoseconds> start_date = default_start_date;
  unsigned hardware_concurrency = 4;  ///< what threads are told; each has a processor of its own nevertheless
  /// Threads at once, from 1 to kernel::tasks_max: one more is a std::system_error.
  std::uint32_t most_tasks = kernel::tasks_max;
  /// Without them each event takes the kernel's plain path: for comparing, since the run is the same.
  /// WAITPOINT_FAST_PATHS=0 in the environment asks for that in every simulation.
  bool fast_paths = true;
};

/// How a run ended, or that it did not.
enum class RunEnd : std::uint8_t {
  time_reached,  ///< or it was stopped by somebody
  ended,         ///< no task remains but services
  deadlock,      ///< tasks wait for each other, or none can ever run
  no_progress,   ///< tasks spin while virtual time stands still
};

class Simulation final : public sync::RunContext {
 public:
  /// Throws std::system_error where the process may not have the address space that a run takes.
  explicit Simulation(SimulationOptions options = {});
  /// Unwinds what is left.
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// After unwind(): as a new one with the same options but for the seed. The robots that were added are gone. For many
  /// short runs: it takes a microsecond, as memory stays in place.
  void restart(std::uint64_t seed);

  /// The lane of tasks that belong to no robot.
  kernel::Robot& environment() { return environment_; }
  const kernel::Robot& environment() const { return environment_; }
  /// `name` must be new.
  kernel::Robot& add_robot(const std::string& name);

  /// A task that starts at virtual time 0, or now if the run has begun. To be called from outside tasks. Throws
  /// std::system_error where no more can be had.
  void spawn(kernel::Robot& robot, const kernel::SpawnOptions& options, std::function<void()> body);

  /// Executes all events before `until`; may be called again with a later time. An exception that escaped from a task
  /// is rethrown here, and at every later call.
  RunEnd run_before(Time until = Time::max());

  /// What run_before() found, in words: a deadlock, a lack of progress, who sleeps for ever, from which task an
  /// exception escaped, and when. Else empty.
  const std::string& trouble() const { return trouble_; }
  /// Whether trouble() says where in the source tasks wait, as it does otherwise: for who has many troubles.
  void tell(sync::Places places) { places_ = places; }

  /// Ends every task that is left. Nothing can be run afterwards.
  void unwind();
  /// After unwind(): the tasks that did not leave, "name of robot" each, and leak what their frames own: they waited
  /// in a destructor, or go on and on although every call throws.
  std::vector<std::string> abandoned() const;

  /// Of the robots in the order of their names, then of the environment.
  Digest digest() const;
  const SimulationOptions& options() const { return options_; }
  Time global_time() const { return scheduler_.global_time(); }
  kernel::Scheduler& scheduler() { return scheduler_; }
  const kernel::Scheduler& scheduler() const { return scheduler_; }

  static Simulation& of(kernel::Scheduler& scheduler) { return static_cast<Simulation&>(RunContext::of(scheduler)); }
  std::chrono::sys_time<std::chrono::nanoseconds> start_date() const override { return options_.start_date; }
  unsigned hardware_concurrency() const override { return options_.hardware_concurrency; }
  /// From within a task: ends the run with an exception. `how` and the task's name begin what trouble() says of it.
  void fail(std::exception_ptr failure, const char* how = "an exception escaped from") override;

 private:
  SimulationOptions options_;
  kernel::Scheduler scheduler_;
  kernel::Robot environment_;
  std::deque<kernel::Robot> robots_;
  std::set<std::string_view> names_;            // of those
  std::deque<sync::RobotStates> robot_states_;  // of the environment, then of the robots
  static void terminate_task();
  void add(kernel::Robot& robot, const char* name);

  std::exception_ptr failure_;
  std::string trouble_;
  sync::Places places_ = sync::Places::told;
  std::terminate_handler terminate_ = nullptr;  // what std::terminate called before unwind() did
};

/// What one simulated run of a test body came to.
struct Report {
  bool passed = false;
  RunEnd end = RunEnd::ended;
  std::string text;  ///< what happened and how to repeat it; empty if it passed
  Digest digest;
  Time end_time;
  std::uint64_t events = 0;
  std::vector<std::string> abandoned;  ///< see Simulation::abandoned
};

std::ostream& operator<<(std::ostream& out, const Report& report);

/// Runs `body` as the first task of a run of its own, until no task remains but services. An exception that escapes
/// from a task is a failure of the report. WAITPOINT_SEED in the environment asks for that seed's order in place of
/// `options`; BadInput where that is no number.
Report simulate(std::function<void()> body, SimulationOptions options = {});

}  // namespace waitpoint
