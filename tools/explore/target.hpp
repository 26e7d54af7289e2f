// SPDX-License-Identifier: BSD-3-Clause
// What is explored: a scenario, or a program of which nothing is known but that it runs. Each schedule is a run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/time.hpp"
#include "tools/explore/explore_options.hpp"
#include "tools/explore/finding.hpp"
#include "tools/explore/plan.hpp"

namespace waitpoint::tools {

class Target {
 public:
  /// What is to be seen of a run beside what it comes to.
  struct Request {
    bool profile = false;
    bool learn = false;    ///< for the profile: which code accesses memory that tasks share
    bool choices = false;  ///< all that were chosen
    bool words = false;    ///< switches in words
    bool places = false;   ///< where in the source tasks stand that a report names
    bool events = false;   ///< the last of them, and with ExploreOptions::trace the trace
    Time events_from = Time();
    std::optional<std::size_t> decision = {};  ///< what was chosen there
    std::optional<std::size_t> log_from = {};  ///< the events behind this decision
    std::optional<std::uint32_t> trail = {};   ///< of a scenario: a mark behind each 2^N events; not beside the above
    /// It ends before this event: what its task is about to do, and where it stands.
    std::optional<exploration::EventOf> stop_before = {};
  };

  virtual ~Target() = default;

  /// As it is called in reports.
  virtual std::string name() const = 0;
  /// Of all that its files and the options say: another target has another one.
  virtual std::uint64_t fingerprint() const = 0;
  /// Whether runs differ in more than their schedules: then each number has noise of its own, and the first has what
  /// the target itself says.
  virtual bool has_noise() const = 0;
  virtual const ExploreOptions& options() const = 0;

  /// Goes to where all runs set out from. BadInput where it does not come as far.
  virtual void prepare() = 0;
  /// How the default order goes from there: for strategies that are to know.
  virtual void set_profile(exploration::Profile profile) = 0;

  /// Of each run from now on, by the wall clock; 0: none.
  void set_limit(double seconds) { limit_s_ = seconds; }
  double limit_s() const { return limit_s_; }

  /// One run, by the plan: in a process that does nothing else.
  virtual Finding run(const Plan& plan, const Request& request) = 0;
  Finding run(const Plan& plan) { return run(plan, Request()); }

 private:
  double limit_s_ = 0;
};

/// Whether schedules that a strategy draws depend on how the default order goes.
bool needs_profile(const std::string& strategy);

}  // namespace waitpoint::tools
