// SPDX-License-Identifier: BSD-3-Clause
// Enumerates all schedules of a target: each is derived from the results of the one before.
#pragma once

#include <optional>
#include <string>

#include "fibers/explore/search/omissions.hpp"
#include "fibers/explore/target/plan.hpp"
#include "tools/explore/runs/finding.hpp"

namespace waitpoint::tools {

class Exhaustive {
 public:
  virtual ~Exhaustive() = default;

  /// The first schedule, the default order.
  virtual Plan first() const = 0;
  /// The successor of the schedule of `finding`, whose choices were requested; nothing after the last. BadInput if the
  /// strategy cannot continue for this program.
  std::optional<Plan> after(const ProcessFinding& finding);
  /// The scope of the search when it is exhausted: " with at most 2 preemptions, except turns of spinning tasks";
  /// nothing if a schedule was lost, with those that follow from it, or if schedules prove nothing.
  std::optional<std::string> scope() const;
  /// The reason why all schedules are not all orders; empty if they are.
  std::string unproved() const;

 protected:
  explicit Exhaustive(std::string scope) : scope_(std::move(scope)) {}

 private:
  virtual std::optional<Plan> next(const ProcessFinding& finding) = 0;

  std::string scope_;
  bool is_broken_ = false, is_at_calls_ = false, has_futexes_ = false, is_outside_ = false;
  exploration::Omissions omissions_;
};

}  // namespace waitpoint::tools
