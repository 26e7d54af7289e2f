// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/depth_first.hpp"

#include "fibers/explore/strategies/schedule.hpp"

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

std::optional<Plan> DepthFirst::next(const ProcessFinding& finding) {
  const std::vector<Decision>& decisions = finding.lesson.choices;
  std::uint32_t preempted = 0;
  std::optional<Deviation> last;
  for (std::uint32_t at = 0; at < decisions.size(); ++at) {
    const Decision& decision = decisions[at];
    const std::uint32_t next = next_alternative(decision);
    if (next < decision.count && (!decision.can_continue || preempted < preemptions_)) last = {at, next};
    if (decision.can_continue && decision.is_switch()) ++preempted;
  }
  if (!last) return std::nullopt;
  Plan plan = first();
  for (std::uint32_t at = 0; at < last->decision; ++at)
    if (decisions[at].is_switch()) plan.deviations.push_back({at, decisions[at].chosen});
  plan.deviations.push_back(*last);
  return plan;
}

}  // namespace waitpoint::tools
