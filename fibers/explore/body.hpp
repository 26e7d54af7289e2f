// SPDX-License-Identifier: BSD-3-Clause
// The body of a test, run under one schedule after the other, in one place in memory.
#pragma once

#include <functional>
#include <string>

#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/sync/simulation.hpp"

namespace waitpoint::exploration {

/// What else can find a fault with a run, beside what the kernel sees: a test framework's expectations.
class ForeignChecks {
 public:
  virtual ~ForeignChecks() = default;
  /// A run begins.
  virtual void begin() = 0;
  /// It is over: what failed since begin(), in words; empty if nothing.
  virtual std::string end() = 0;
  /// Of the test that is running, and the program's option that runs it alone; empty where there is none.
  virtual std::string name() const = 0;
  virtual std::string option_for(const std::string& name) const = 0;
};

/// A test framework says so when the tests that were to run have, and before it says that they have passed. Where
/// WAITPOINT_REPLAY asks for a run that was not come to, the program ends here, with a line and status 2.
void tests_are_over();

/// What a schedule came to.
struct Outcome {
  RunEnd end = RunEnd::ended;
  std::string failure;   ///< in words, its first line what happened; empty if it passed
  bool was_cut = false;  ///< it did not end, as nothing new could have followed; it has passed then
  std::uint64_t digest = 0;
  Time end_time;
  std::uint64_t events = 0;
  std::vector<std::string> abandoned;

  bool passed() const { return failure.empty(); }
};

class Body {
 public:
  /// `checks` may be null. A schedule has `until` of virtual time, and `steps_max` switch points at one instant.
  Body(std::function<void()> function, ForeignChecks* checks, Time until, std::uint32_t steps_max);

  /// Runs it from the beginning, by `strategy`, which was begun for it, but for what is played.
  Outcome run(Strategy& strategy, const Played& played = {});
  /// As run(), up to the decision where `played` stops; then `look` is called, before all is unwound.
  void run_up_to(const Played& played, const std::function<void()>& look);

  /// As run() with that schedule, with `decisions` between the kernel and the explorer.
  void run_watched_by(kernel::Decisions& decisions, const Schedule& schedule);

  /// Data races are failures, unless this is called.
  void ignore_races() { heeds_races_ = false; }
  /// Whether failures say where in the source tasks are: that takes a second. They do not, unless it is asked for.
  void tell(sync::Places places);

  const Explorer& explorer() const { return explorer_; }
  Explorer& explorer() { return explorer_; }
  Simulation& simulation() { return simulation_; }

 private:
  void start(Strategy& strategy, const Played& played);

  std::function<void()> function_;
  ForeignChecks* checks_;
  Time until_;
  Simulation simulation_;
  kernel::FaultReports reports_;  // once, not for each schedule
  Explorer explorer_;
  sync::Places places_ = sync::Places::left_out;
  bool heeds_races_ = true;
  bool used_ = false;
};

}  // namespace waitpoint::exploration
