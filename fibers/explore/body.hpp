// SPDX-License-Identifier: BSD-3-Clause
// The body of a test, run repeatedly under different schedules, at a fixed place in memory.
#pragma once

#include <exception>
#include <functional>
#include <string>

#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/explore/strategies/memory_option.hpp"
#include "fibers/explore/target/finding.hpp"
#include "fibers/explore/target/plan.hpp"
#include "fibers/explore/target/wanted_evidence.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/sync/simulation.hpp"

namespace waitpoint::exploration {

class EvidenceRecorder;

/// An external source of failures, beside the kernel's checks: a test framework's expectations.
class ExternalChecks {
 public:
  virtual ~ExternalChecks() = default;
  /// Called at the start of a run.
  virtual void begin() = 0;
  /// Called at the end of the run: the failures since begin(), as text; empty if none.
  virtual std::string end() = 0;
  /// True for the exception that only ends a test after a failure that end() tells: it is not shown itself.
  virtual bool is_own(const std::exception_ptr&) const { return false; }
  /// The name of the running test, and the program's option that runs it alone; empty if there is none.
  virtual std::string name() const = 0;
  virtual std::string option_for(const std::string& name) const = 0;

 protected:
  template <class Exception>
  static bool is(const std::exception_ptr& exception) {
    try {
      std::rethrow_exception(exception);
    } catch (const Exception&) {
      return true;
    } catch (...) {
      return false;
    }
  }
};

/// Called by a test framework after the last test, before it prints the result. If the run of WAITPOINT_REPLAY was
/// never reached, the program ends here, with a line and status 2.
void on_tests_finished();

class Body {
 public:
  /// `checks` may be null. The limits of a schedule are `until` in virtual time, and `steps_max` switch points at one
  /// instant. `memory` is that of instrumented code.
  Body(std::function<void()> function, ExternalChecks* checks, Time until, std::uint32_t steps_max,
       Memory memory = Memory::sc);

  /// Runs it from the beginning: first `played`, then `strategy`, which must have begun this schedule.
  RunVerdict run(Strategy& strategy, const Played& played = {});
  /// The last run's failure, whose first line is the headline; empty if it passed.
  const std::string& failure() const { return failure_; }
  /// The finding of the last run, which had this verdict, with its choices.
  Finding finding_of(const RunVerdict& verdict) const;
  /// Runs it by a plan that is not drawn, and records what is wanted.
  Finding repeat(const Plan& plan, const WantedEvidence& wanted);
  /// As run(), up to the decision where `played` stops; then calls `look`, before everything is unwound.
  void run_up_to(const Played& played, const std::function<void()>& look);

  ~Body();

  Memory memory() const { return memory_; }
  /// Data races no longer count as failures.
  void ignore_races() { fails_on_races_ = false; }
  const Explorer& explorer() const { return explorer_; }
  Explorer& explorer() { return explorer_; }
  Simulation& simulation() { return simulation_; }

 private:
  void start(Strategy& strategy, const Played& played);
  RunVerdict carry_out(Strategy& strategy, const Played& played, Time until, EvidenceRecorder* recording);
  void judge(RunEnd end, Time until, bool may_end_early, RunVerdict& verdict);
  // Looking up source locations takes a second.
  void tell(sync::Places places);

  std::function<void()> function_;
  ExternalChecks* checks_;
  Time until_;
  Simulation simulation_;
  kernel::FaultReports reports_;  // installed once, not per schedule
  Explorer explorer_;
  sync::Places places_ = sync::Places::left_out;
  std::string failure_;
  const Memory memory_;
  bool fails_on_races_ = true;
  bool used_ = false;
};

}  // namespace waitpoint::exploration
