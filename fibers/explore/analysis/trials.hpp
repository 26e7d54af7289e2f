// SPDX-License-Identifier: BSD-3-Clause
// The runs of a part of an analysis, within its budget. A cheap target's has no limit of time, so that a failure always
// gets the same report.
#pragma once

#include <algorithm>
#include <string>

#include "fibers/explore/target/progress_listener.hpp"
#include "fibers/explore/target/target.hpp"
#include "fibers/explore/target/time_limit.hpp"

namespace waitpoint::exploration {

class Trials {
 public:
  /// `progress` may be null.
  Trials(Target& target, ProgressListener* progress, const Effort& effort)
      : target_(target), traits_(target.traits()), progress_(progress), left_(effort), time_limit_(effort.seconds) {}

  const TargetTraits& traits() const { return traits_; }
  /// Runs so far.
  std::uint64_t used() const { return used_; }
  /// The first run of the gravest kind, but for those that were killed, which cannot be repeated; or one that passed.
  const Finding& gravest() const { return gravest_; }
  /// The budget is exhausted, or a signal has interrupted a run.
  bool is_over() const { return is_over_; }

  /// A run by the plan; nothing once it is over. `activity`, in words, is for the progress.
  template <class Words>
  std::optional<Finding> run(const Plan& plan, const WantedEvidence& wanted, const Words& activity) {
    is_over_ = is_over_ || used_ == left_.runs || left_.events == 0 || time_limit_.is_over();
    if (is_over_) return std::nullopt;
    ++used_;
    if (progress_ != nullptr) {
      std::string words = activity();
      words.append(", run ").append(std::to_string(used_));
      progress_->update(words);
    }
    std::optional<Finding> finding = target_.repeat(plan, wanted);
    is_over_ = !finding;
    if (!finding) return finding;
    left_.events -= std::min(left_.events, finding->events);
    if (finding->kind > gravest_.kind && finding->kind != RunVerdict::Kind::killed) gravest_ = *finding;
    return finding;
  }

 private:
  Target& target_;
  const TargetTraits traits_;
  ProgressListener* progress_;
  Effort left_;  // but for the runs
  const TimeLimit time_limit_;
  std::uint64_t used_ = 0;
  Finding gravest_;
  bool is_over_ = false;
};

}  // namespace waitpoint::exploration
