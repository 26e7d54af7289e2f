// SPDX-License-Identifier: BSD-3-Clause
// The runs of a part of an analysis, within its budget.
#pragma once

#include <string>

#include "fibers/explore/analysis/budget.hpp"
#include "fibers/explore/target/progress_listener.hpp"
#include "fibers/explore/target/target.hpp"

namespace waitpoint::exploration {

class Trials {
 public:
  /// `progress` may be null.
  Trials(Target& target, ProgressListener* progress, const Effort& effort)
      : target_(target), traits_(target.traits()), progress_(progress), budget_(effort) {}

  const TargetTraits& traits() const { return traits_; }
  /// Runs so far.
  std::uint64_t used() const { return budget_.used(); }
  /// The budget is exhausted, or a signal has interrupted a run.
  bool is_over() const { return is_over_; }

  /// A run by the plan; nothing once it is over. `activity`, in words, is for the progress.
  template <class Words>
  std::optional<Finding> run(const Plan& plan, const WantedEvidence& wanted, const Words& activity) {
    is_over_ = is_over_ || !budget_.take();
    if (is_over_) return std::nullopt;
    if (progress_ != nullptr) {
      std::string words = activity();
      words.append(", run ").append(std::to_string(budget_.used()));
      progress_->update(words);
    }
    std::optional<Finding> finding = target_.repeat(plan, wanted);
    is_over_ = !finding;
    if (finding) budget_.spend(*finding);
    return finding;
  }

 private:
  Target& target_;
  TargetTraits traits_;
  ProgressListener* progress_;
  Budget budget_;
  bool is_over_ = false;
};

}  // namespace waitpoint::exploration
