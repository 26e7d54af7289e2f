// SPDX-License-Identifier: BSD-3-Clause
// The interface of all strategies: they choose the next schedule of a body.
//
// A strategy picks the next of the ready tasks at each switch point, and the alternative of each other choice. It knows
// the kernel's view of the tasks: the pending operation of each, and its object. Its random numbers come from the
// schedule's own stream. Its knowledge of the body is the Profile, the same for every schedule of a campaign; only
// exhaustive strategies and those with feedback carry state from one schedule to the next.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "fibers/explore/strategies/draws.hpp"
#include "fibers/explore/strategies/profile.hpp"
#include "fibers/explore/strategies/reads_from.hpp"
#include "fibers/kernel/decisions.hpp"

namespace waitpoint::exploration {

using kernel::Choice;
using kernel::Task;

/// A switch point.
struct SwitchPoint {
  std::span<Task* const> ready;  ///< at least one, in the order in which they became ready
  const Task* last;              ///< the task of the last event; null at the first of an instant
  bool can_continue;             ///< `last` is ready and does not spin
  std::uint32_t step;            ///< number of earlier switch points
};

class Strategy {
 public:
  virtual ~Strategy() = default;

  /// Starts schedule `number` of the campaign, with the random numbers `draws`.
  virtual void begin(std::uint64_t number, const Draws& draws, const Profile& profile) = 0;
  /// The strategy that decides in the current schedule, for a composite of several.
  virtual Strategy& deciding() { return *this; }
  /// Returned instead of an index: abandons the schedule, since nothing new can follow.
  static constexpr std::uint32_t cut = 0xFFFFFFFF;

  /// The index of the next task.
  virtual std::uint32_t next(const SwitchPoint& at) = 0;
  /// One of `count` alternatives, at least two.
  virtual std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) = 0;
  /// A task polls, while others can continue: whether it goes on alone up to its next event that is no poll.
  virtual bool lets_poll_on() { return false; }
  /// The first schedule, `from` or a later one, whose course those after it depend on: it must be run before them.
  virtual std::uint64_t first_learned(std::uint64_t from) const { return is_exhaustive() ? from : none; }
  static constexpr std::uint64_t none = ~std::uint64_t{0};
  /// The first schedule, `from` or a later one, that learns also from schedules which other processes have executed: by
  /// hold(), and the pairs of those.
  virtual std::uint64_t first_held(std::uint64_t) const { return none; }
  /// Before begin(), for such a schedule: what those before have led to.
  virtual void hold(std::span<const Constraint>) {}
  /// Ends the schedule; false if no other is left to try.
  virtual bool end() { return true; }
  /// Of an exhaustive strategy: " with at most 2 preemptions", or "" if it tries all.
  virtual std::string scope() const { return ""; }
  /// True if end() reports that all schedules have been tried.
  virtual bool is_exhaustive() const { return false; }
};

}  // namespace waitpoint::exploration
