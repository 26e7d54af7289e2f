// SPDX-License-Identifier: BSD-3-Clause
// The subject of an exploration: a scenario, or an arbitrary program. Each schedule is a run.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"
#include "tools/explore/runs/explore_options.hpp"
#include "tools/explore/runs/finding.hpp"
#include "tools/explore/runs/plan.hpp"
#include "tools/processes/children.hpp"

namespace waitpoint::tools {

class Target {
 public:
  /// The data requested of a run besides its outcome.
  struct Request {
    bool profile = false;
    bool learn = false;    ///< for the profile: code that accesses memory shared by tasks
    bool choices = false;  ///< all choices made
    bool pairs = false;    ///< what a strategy with feedback learns from
    bool words = false;    ///< switches in words
    bool places = false;   ///< source locations of the tasks in reports
    bool events = false;   ///< the last ones, and with ExploreOptions::trace the trace
    Time events_from = Time();
    std::optional<std::size_t> decision = {};  ///< describe the choice made there
    std::optional<std::size_t> log_from = {};  ///< the events after this decision
    std::optional<std::uint32_t> trail = {};   ///< of scenarios: a mark after each 2^N events; excludes the above
    bool page = false;                         ///< with the events also in columns, and of a scenario the floor
    std::uint32_t marked_count = 0;
    std::array<exploration::EventOf, 2> marked = {};  ///< in the columns: so many of these
    /// Ends the run before this event, and describes its task's next operation and call stack.
    std::optional<exploration::EventOf> stop_before = {};

    std::span<const exploration::EventOf> marks() const { return std::span(marked).first(marked_count); }
  };

  /// The same request for further schedules, whose numbers grow by `step`; up to the first that does not pass.
  struct Repeats {
    std::uint64_t step = 1;
    std::uint32_t count = 0;
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
  /// The default order's profile, for strategies that need it. There must be no run.
  void set_profile(exploration::Profile profile);
  /// Wall clock limit of each following run; 0: none. There must be no run.
  void set_limit(double seconds);

  /// All following runs have these switch points. There must be no run.
  void switch_at(std::optional<SwitchAt> at);

  /// Data races are no failures of the following runs. There must be no run.
  void ignore_races();

  /// Executes one run by the plan, in a process that does nothing else.
  virtual Finding run(const Plan& plan, const Request& request) = 0;
  Finding run(const Plan& plan) { return run(plan, Request()); }

  /// The processes that execute runs, by requests.
  Children& runs();
  static std::string to_request(const Plan& plan, const Request& request) {
    return to_request(plan, request, Repeats());
  }
  static std::string to_request(const Plan& plan, const Request& request, const Repeats& repeats);
  /// The findings of the plan and its repeats, from the process that has run them; one that it was killed, if it was.
  static std::vector<Finding> findings_of(const Children::Ended& ended);
  /// The greatest number of schedules that one process can run in turn.
  std::uint32_t batch_max() const { return has_processes() ? 16 : 1; }

 protected:
  /// True if runs are processes by themselves: one process can execute several, one after the other, and waits for
  /// them.
  virtual bool has_processes() const = 0;
  double limit_s() const { return limit_s_; }
  bool races_fail() const { return races_fail_; }
  const std::optional<SwitchAt>& fixed_switch_at() const { return fixed_switch_at_; }
  exploration::Profile profile_;

 private:
  std::string execute(std::string_view request);

  double limit_s_ = 0;
  bool races_fail_ = true;
  std::optional<SwitchAt> fixed_switch_at_;
  std::optional<Children> runs_;
};

/// True if the schedules that this strategy draws depend on the default order's profile.
bool needs_profile(const std::string& strategy);

}  // namespace waitpoint::tools
