// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/pos.hpp"

#include "fibers/explore/strategies/dependence.hpp"

namespace waitpoint::exploration {

std::uint32_t Pos::next(const SwitchPoint& at) {
  std::uint32_t best = 0;
  std::uint64_t highest = 0;
  for (std::uint32_t i = 0; i < at.ready.size(); ++i) {
    const Task& task = *at.ready[i];
    if (pending_.size() <= task.number) pending_.resize(task.number + 1);
    Pending& pending = pending_[task.number];
    if (pending.sequence != task.sequence) pending = {task.sequence, draws_.bits()};
    if (pending.priority <= highest) continue;
    best = i;
    highest = pending.priority;
  }
  const Task& chosen = *at.ready[best];
  for (const Task* other : at.ready)
    if (other != &chosen && are_dependent(*other, chosen)) pending_[other->number].priority = draws_.bits();
  return best;
}

}  // namespace waitpoint::exploration
