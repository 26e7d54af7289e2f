// SPDX-License-Identifier: BSD-3-Clause
// The interface behind which all strategies stand: which schedule of a body is tried next.
//
// A strategy is asked at each switch point which of the ready tasks goes on, and for each other choice. It knows of the
// tasks what the kernel does: what each is about to do, and at which object. Its random numbers come from the
// schedule's own stream. What it learns, it learns from the Profile, which is the same for every schedule of a
// campaign; only exhaustive strategies carry something from one schedule to the next.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "fibers/explore/strategies/draws.hpp"
#include "fibers/explore/strategies/profile.hpp"
#include "fibers/kernel/decisions.hpp"

namespace waitpoint::exploration {

using kernel::Choice;
using kernel::Task;

/// A switch point.
struct SwitchPoint {
  std::span<Task* const> ready;  ///< at least one, in the order in which they came to be so
  const Task* last;              ///< whose event was executed last; null at the first of an instant
  bool may_go_on;                ///< it is among the ready, and does not spin
  std::uint32_t step;            ///< switch points before this one
};

class Strategy {
 public:
  virtual ~Strategy() = default;

  /// Schedule `number` of the campaign begins; its random numbers are `draws`.
  virtual void begin(std::uint64_t number, const Draws& draws, const Profile& profile) = 0;
  /// Who decides in the schedule that was begun: another one, where this one is made of several.
  virtual Strategy& deciding() { return *this; }
  /// In place of an index: nothing new can follow, the schedule is not worth going on with.
  static constexpr std::uint32_t cut = 0xFFFFFFFF;

  /// The index of the task that goes on.
  virtual std::uint32_t next(const SwitchPoint& at) = 0;
  /// Which of `count` alternatives, at least two.
  virtual std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) = 0;
  /// The schedule is over; false if there is no other left to try.
  virtual bool end() { return true; }
  /// Of an exhaustive one: " with at most 2 preemptions", or nothing if it tries all.
  virtual std::string scope() const { return ""; }
  /// Whether end() will tell when all schedules have been tried.
  virtual bool is_exhaustive() const { return false; }
};

}  // namespace waitpoint::exploration
