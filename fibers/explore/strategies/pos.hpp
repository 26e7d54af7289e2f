// SPDX-License-Identifier: BSD-3-Clause
// POS: partial order sampling (Yuan, Yang, Gu, "Partial order aware concurrency sampling", CAV 2018). Each pending
// event has a random priority; the highest executes, and those that race with it, i.e. that are dependent, redraw. So
// both orders of two racing events are equally likely, however far apart they are.
#pragma once

#include "fibers/explore/strategies/dependence.hpp"
#include "fibers/explore/strategies/drawn.hpp"

namespace waitpoint::exploration {

/// The priorities of the pending events of one schedule.
class EventPriorities {
 public:
  void clear(Memory memory) {
    pending_.clear();
    memory_ = memory;
  }

  /// The index of the event of the highest priority among those that `permits(task)`; of all, if it permits none.
  template <class Permits>
  std::uint32_t next(const SwitchPoint& at, Draws& draws, Permits permits) {
    std::uint32_t best = 0;
    std::uint64_t highest = 0;
    bool is_permitted = false;
    for (std::uint32_t i = 0; i < at.ready.size(); ++i) {
      const std::uint64_t priority = priority_of(*at.ready[i], draws);
      const bool is_one = permits(*at.ready[i]);
      if (is_permitted ? !is_one || priority <= highest : !is_one && priority <= highest) continue;
      is_permitted = is_permitted || is_one;
      best = i;
      highest = priority;
    }
    redraw_racing(at, *at.ready[best], draws);
    return best;
  }

 private:
  struct Pending {
    std::uint64_t sequence = ~std::uint64_t{0};  // the event of the priority
    std::uint64_t priority = 0;
  };

  std::uint64_t priority_of(const Task& task, Draws& draws) {
    if (pending_.size() <= task.number) pending_.resize(task.number + 1);
    Pending& pending = pending_[task.number];
    if (pending.sequence != task.sequence) pending = {task.sequence, draws.bits()};
    return pending.priority;
  }
  void redraw_racing(const SwitchPoint& at, const Task& chosen, Draws& draws) {
    if (at.ready.size() == 1) return;
    const Action action = action_of(chosen);
    for (const Task* other : at.ready)
      if (other != &chosen && are_dependent(action_of(*other), action, memory_))
        pending_[other->number].priority = draws.bits();
  }

  std::vector<Pending> pending_;  // by Task::number
  Memory memory_ = Memory::sc;
};

class Pos final : public Drawn {
 public:
  std::uint32_t next(const SwitchPoint& at) override {
    return priorities_.next(at, draws_, [](const Task&) { return true; });
  }

 private:
  void start(const Profile& profile) override { priorities_.clear(profile.memory); }

  EventPriorities priorities_;
};

}  // namespace waitpoint::exploration
