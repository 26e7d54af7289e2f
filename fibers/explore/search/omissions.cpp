// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/search/omissions.hpp"

#include "fibers/explore/strategies/memory_option.hpp"

namespace waitpoint::exploration {

using kernel::Choice;

void Omissions::take(const RunVerdict& verdict, std::span<const Decision> choices) {
  turns_ |= verdict.cuts_polls_short;
  accesses_ |= verdict.has_unlearned_code;
  values_ |= verdict.has_left_out_values;
  is_at_calls_ |= verdict.switch_at == SwitchAt::calls;
  has_futexes_ |= verdict.uses_futexes && verdict.switch_at == SwitchAt::calls;
  is_outside_ |= verdict.meets_outside;
  has_generated_code_ |= verdict.generated_code > 0;
  for (const Decision& decision : choices) {
    turns_ |= decision.spinning != 0;
    costs_ |= decision.choice == Choice::computing && decision.count > 2;
    spurious_ |= decision.choice == Choice::spurious;
  }
}

std::string Omissions::unproved() const {
  if (is_outside_) return "the program has waited for what is not simulated";
  if (has_generated_code_) return "the program generates code, whose accesses are no switch points";
  if (has_futexes_)
    return "the program waits by futexes of its own, and the atomics beside them are switch points with --switch-at "
           "accesses only";
  return "";
}

std::string Omissions::in_words() const {
  std::string text;
  const auto add = [&](bool is_left_out, const char* what) {
    if (is_left_out) text.append(text.empty() ? ", except " : " and ").append(what);
  };
  add(turns_, "turns of spinning tasks");
  add(costs_, "computing costs between the bounds");
  add(spurious_, "spurious wake-ups");
  add(accesses_, "switches at first accesses to memory that the default order does not share");
  add(values_, values_left_out);
  return (is_at_calls_ ? ", switching at calls" : "") + text;
}

}  // namespace waitpoint::exploration
