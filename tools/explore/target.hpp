// SPDX-License-Identifier: BSD-3-Clause
// The subject of an exploration: a scenario, or an arbitrary program. Each schedule is a run.
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
  /// The data requested of a run besides its outcome.
  struct Request {
    bool profile = false;
    bool learn = false;    ///< for the profile: code that accesses memory shared by tasks
    bool choices = false;  ///< all choices made
    bool words = false;    ///< switches in words
    bool places = false;   ///< source locations of the tasks in reports
    bool events = false;   ///< the last ones, and with ExploreOptions::trace the trace
    Time events_from = Time();
    std::optional<std::size_t> decision = {};  ///< describe the choice made there
    std::optional<std::size_t> log_from = {};  ///< the events after this decision
    std::optional<std::uint32_t> trail = {};   ///< of scenarios: a mark after each 2^N events; excludes the above
    /// Ends the run before this event, and describes its task's next operation and call stack.
    std::optional<exploration::EventOf> stop_before = {};
  };

  virtual ~Target() = default;

  /// The name in reports.
  virtual std::string name() const = 0;
  /// Digest of the target's files and options: distinct for distinct targets.
  virtual std::uint64_t fingerprint() const = 0;
  /// True if runs differ in more than their schedules: then each number has its own noise, and number 0 the target's
  /// own.
  virtual bool has_noise() const = 0;
  virtual const ExploreOptions& options() const = 0;

  /// Advances to the common origin of all runs. BadInput if the target ends before it.
  virtual void prepare() = 0;
  /// The default order's profile, for strategies that need it.
  virtual void set_profile(exploration::Profile profile) = 0;

  /// Wall clock limit of each following run; 0: none.
  void set_limit(double seconds) { limit_s_ = seconds; }
  double limit_s() const { return limit_s_; }

  /// Executes one run by the plan, in a process that does nothing else.
  virtual Finding run(const Plan& plan, const Request& request) = 0;
  Finding run(const Plan& plan) { return run(plan, Request()); }

 private:
  double limit_s_ = 0;
};

/// True if the schedules that this strategy draws depend on the default order's profile.
bool needs_profile(const std::string& strategy);

}  // namespace waitpoint::tools
