// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/exhaustive.hpp"

namespace waitpoint::tools {

using exploration::Decision;
using kernel::Choice;

std::optional<Plan> Exhaustive::after(const ProcessFinding& finding) {
  if (finding.kind == ProcessFinding::Kind::killed) {
    is_broken_ = true;
    return std::nullopt;
  }
  omissions_.turns = omissions_.turns || finding.cuts_polls_short;
  omissions_.accesses = omissions_.accesses || finding.has_unlearned_code;
  is_at_calls_ = is_at_calls_ || finding.switch_at == SwitchAt::calls;
  has_futexes_ = has_futexes_ || (finding.uses_futexes && finding.switch_at == SwitchAt::calls);
  is_outside_ = is_outside_ || finding.meets_outside;
  omissions_.values = omissions_.values || finding.has_left_out_values;
  for (const Decision& decision : finding.lesson.choices) {
    omissions_.turns = omissions_.turns || decision.spinning != 0;
    omissions_.costs = omissions_.costs || (decision.choice == Choice::computing && decision.count > 2);
    omissions_.spurious = omissions_.spurious || decision.choice == Choice::spurious;
  }
  return next(finding);
}

std::optional<std::string> Exhaustive::scope() const {
  if (is_broken_ || !unproved().empty()) return std::nullopt;
  return scope_ + (is_at_calls_ ? ", switching at calls" : "") + omissions_.in_words();
}

std::string Exhaustive::unproved() const {
  if (is_outside_) return "the program has waited for what is not simulated";
  if (has_futexes_)
    return "the program waits by futexes of its own, and the atomics beside them are switch points with --switch-at "
           "accesses only";
  return "";
}

}  // namespace waitpoint::tools
