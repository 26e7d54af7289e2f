// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/depth_first.hpp"

#include "fibers/explore/strategies/dfs.hpp"
#include "fibers/explore/strategies/factory.hpp"

namespace waitpoint::tools {

using exploration::Decision;
using exploration::Deviation;
using kernel::Choice;

namespace {

// Tries the default alternative first, then the others in order, skipping tasks that spin. Returns the count when none
// is left.
std::uint32_t next_alternative(const Decision& decision) {
  if (decision.choice == Choice::spurious) return decision.count;  // spurious wake-ups could repeat without end
  if (decision.choice == Choice::computing) return decision.is_switch() ? decision.count : decision.count - 1;
  std::uint32_t next = decision.is_switch() ? decision.chosen + 1 : 0;
  while (next < decision.count && (next == decision.usual || decision.spins(next))) ++next;
  return next;
}

}  // namespace

std::optional<DepthFirst> DepthFirst::of(const std::string& strategy) {
  const auto made = exploration::make_strategy(strategy);
  const auto* const dfs = dynamic_cast<const exploration::Dfs*>(made.get());
  if (dfs == nullptr) return std::nullopt;
  return DepthFirst(dfs->preemptions(), dfs->scope());
}

std::optional<std::vector<Deviation>> DepthFirst::after(const Finding& finding) {
  const std::vector<Decision>& decisions = finding.choices;
  left_out_turns_ = left_out_turns_ || finding.cuts_polls_short;
  left_out_accesses_ = left_out_accesses_ || finding.has_unlearned_code;
  std::uint32_t preempted = 0;
  std::optional<Deviation> last;
  for (std::uint32_t at = 0; at < decisions.size(); ++at) {
    const Decision& decision = decisions[at];
    left_out_turns_ = left_out_turns_ || decision.spinning != 0;
    left_out_costs_ = left_out_costs_ || (decision.choice == Choice::computing && decision.count > 2);
    left_out_spurious_ = left_out_spurious_ || decision.choice == Choice::spurious;
    const std::uint32_t next = next_alternative(decision);
    if (next < decision.count && (!decision.can_continue || preempted < preemptions_)) last = {at, next};
    if (decision.can_continue && decision.is_switch()) ++preempted;
  }
  if (!last) return std::nullopt;
  std::vector<Deviation> deviations;
  for (std::uint32_t at = 0; at < last->decision; ++at)
    if (decisions[at].is_switch()) deviations.push_back({at, decisions[at].chosen});
  deviations.push_back(*last);
  return deviations;
}

std::string DepthFirst::scope() const {
  std::string but;
  const auto add = [&](bool is_left_out, const char* what) {
    if (is_left_out) but += (but.empty() ? ", except for " : " and ") + std::string(what);
  };
  add(left_out_turns_, "turns of spinning tasks");
  add(left_out_costs_, "computing costs between minimum and maximum");
  add(left_out_spurious_, "spurious wake-ups");
  add(left_out_accesses_, "switches at first accesses to memory that the default order does not share");
  return scope_ + but;
}

}  // namespace waitpoint::tools
