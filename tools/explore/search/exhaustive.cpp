// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/exhaustive.hpp"

#include "fibers/explore/strategies/memory_option.hpp"

namespace waitpoint::tools {

using exploration::Decision;
using kernel::Choice;

std::optional<Plan> Exhaustive::after(const Finding& finding) {
  if (finding.kind == Finding::Kind::killed) {
    is_broken_ = true;
    return std::nullopt;
  }
  left_out_turns_ = left_out_turns_ || finding.cuts_polls_short;
  left_out_accesses_ = left_out_accesses_ || finding.has_unlearned_code;
  is_at_calls_ = is_at_calls_ || finding.switch_at == SwitchAt::calls;
  left_out_values_ = left_out_values_ || finding.has_left_out_values;
  for (const Decision& decision : finding.choices) {
    left_out_turns_ = left_out_turns_ || decision.spinning != 0;
    left_out_costs_ = left_out_costs_ || (decision.choice == Choice::computing && decision.count > 2);
    left_out_spurious_ = left_out_spurious_ || decision.choice == Choice::spurious;
  }
  return next(finding);
}

std::optional<std::string> Exhaustive::scope() const {
  if (is_broken_) return std::nullopt;
  std::string but;
  const auto add = [&](bool is_left_out, const char* what) {
    if (is_left_out) but += (but.empty() ? ", except for " : " and ") + std::string(what);
  };
  add(left_out_turns_, "turns of spinning tasks");
  add(left_out_costs_, "computing costs between minimum and maximum");
  add(left_out_spurious_, "spurious wake-ups");
  add(left_out_accesses_, "switches at first accesses to memory that the default order does not share");
  add(left_out_values_, values_left_out);
  return scope_ + (is_at_calls_ ? ", switching at calls" : "") + but;
}

}  // namespace waitpoint::tools
