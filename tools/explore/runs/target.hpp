// SPDX-License-Identifier: BSD-3-Clause
// A target whose runs are in processes of their own: a scenario, or an arbitrary program.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fibers/explore/search/pair_sample.hpp"
#include "fibers/explore/target/target.hpp"
#include "fibers/explore/target/time_limit.hpp"
#include "tools/exec/watchdog.hpp"
#include "tools/explore/runs/explore_options.hpp"
#include "tools/explore/runs/finding.hpp"
#include "tools/processes/children.hpp"

namespace waitpoint::tools {

class ProcessTarget : public exploration::Target {
 public:
  /// How often a wait for a run heeds signals and limits.
  static constexpr int look_around_ms = 100;

  /// The same request for further schedules, whose numbers grow by `step`; up to the first that does not pass.
  struct Repeats {
    std::uint64_t step = 1;
    std::uint32_t count = 0;
  };

  /// Digest of the target's files and options: distinct for distinct targets.
  virtual std::uint64_t fingerprint() const = 0;
  virtual const ExploreOptions& options() const = 0;
  exploration::TargetTraits traits() const override;
  std::string replay_command(const Finding& finding, const std::string& token) const override;
  /// A run in a process of its own; nothing if it was not waited for.
  std::optional<exploration::Finding> repeat(const Plan& plan, const WantedEvidence& wanted) override {
    return run_apart(plan, wanted);
  }
  std::optional<Finding> run_apart(const Plan& plan, const WantedEvidence& wanted);
  /// The search is interrupted, or its time is over: tells what a program's run that has gone on for long does, and
  /// ends all runs.
  void stop_runs();
  /// A signal asks to end the search, or its time is over: runs are not waited for.
  bool is_at_end() const;

  /// Advances to the common origin of all runs. BadInput if the target ends before it.
  virtual void prepare() = 0;
  /// The default order's profile, for strategies that need it. There must be no run.
  void set_profile(exploration::Profile profile);
  /// Wall clock limit of each following run; 0: none. There must be no run.
  void set_limit(double seconds);

  /// The end of all following runs, whatever they are for. There must be no run.
  void set_time_limit(const exploration::TimeLimit& time_limit);
  const exploration::TimeLimit& time_limit() const { return time_limit_; }

  /// The processor time after which a run that makes no calls is taken for one without progress. There must be no run.
  void set_patience(double seconds);

  /// All following runs have these switch points. There must be no run.
  void switch_at(std::optional<SwitchAt> at);

  /// Data races are no failures of the following runs. There must be no run.
  void ignore_races();

  /// Executes one run by the plan, in a process that does nothing else.
  virtual Finding run(const Plan& plan, const WantedEvidence& wanted) = 0;
  Finding run(const Plan& plan) { return run(plan, WantedEvidence()); }

  /// The processes that execute runs, by requests.
  Children& runs();
  static std::string to_request(const Plan& plan, const WantedEvidence& wanted) {
    return to_request(plan, wanted, Repeats());
  }
  static std::string to_request(const Plan& plan, const WantedEvidence& wanted, const Repeats& repeats);
  /// The findings of the plan and its repeats, from the process that has run them; one that it was killed, if it was.
  static std::vector<Finding> findings_of(const Children::Ended& ended);
  /// The greatest number of schedules that one process can run in turn.
  std::uint32_t batch_max() const { return has_processes() ? 16 : 1; }

 protected:
  /// True if runs are processes by themselves: one process can execute several, one after the other, and waits for
  /// them.
  virtual bool has_processes() const = 0;
  double limit_s() const { return limit_s_; }
  double patience_s() const { return patience_s_; }
  bool races_fail() const { return races_fail_; }
  const std::optional<SwitchAt>& fixed_switch_at() const { return fixed_switch_at_; }
  exploration::Profile profile_;

 private:
  std::string execute(std::string_view request);
  bool is_sampled(const Plan& plan);

  double limit_s_ = 0, patience_s_ = Watchdog::usual_patience_s;
  exploration::TimeLimit time_limit_{0};
  bool races_fail_ = true;
  std::optional<SwitchAt> fixed_switch_at_;
  std::optional<Children> runs_;
  std::optional<exploration::SampledSchedules> sampled_;  // of a process that executes runs
};

/// True if the schedules that this strategy draws depend on the default order's profile.
bool needs_profile(const std::string& strategy);

}  // namespace waitpoint::tools
