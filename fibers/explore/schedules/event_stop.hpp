// SPDX-License-Identifier: BSD-3-Clause
// Sits between the kernel and an explorer for one run, and stops it before a given event of a task.
#pragma once

#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/kernel/run_window.hpp"

namespace waitpoint::exploration {

class EventStop final : public kernel::Decisions {
 public:
  EventStop(kernel::Scheduler& scheduler, Explorer& explorer, EventOf event)
      : scheduler_(scheduler), explorer_(explorer), event_(event) {}

  /// The task about to execute the event; null until the run has reached it.
  Task* stopped_before() const { return stopped_before_; }

  std::uint32_t next(Task* const* ready, std::uint32_t count) override {
    const std::uint32_t chosen = explorer_.next(ready, count);
    if (chosen >= count || event_of(*ready[chosen]) != event_) return chosen;
    stopped_before_ = ready[chosen];
    kernel::stop_between_events(scheduler_, kernel::StopCause::requested, *stopped_before_);
    return chosen;
  }
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override {
    return explorer_.among(choice, task, count);
  }
  Duration computing(const Task& task, Duration least, Duration greatest) override {
    return explorer_.computing(task, least, greatest);
  }

 private:
  kernel::Scheduler& scheduler_;
  Explorer& explorer_;
  EventOf event_;
  Task* stopped_before_ = nullptr;
};

}  // namespace waitpoint::exploration
