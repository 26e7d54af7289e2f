// SPDX-License-Identifier: BSD-3-Clause
// A schedule as the choices that were made: they are what a run repeats by, what is cut shorter to explain it, and what
// is stored.
//
// Only what was a choice stands in it: two alternatives or more. The usual one is what the default order would have
// done: the running task goes on, else the one that has been ready longest, of those that do not spin; the first
// waiter; the longest computation. What differs from that, the switches, says by tasks and their events where it was
// made: so it keeps its meaning when others are left out, or the code around it is edited.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "fibers/kernel/decisions.hpp"

namespace waitpoint::exploration {

/// An event of a task, done or about to be done.
struct EventOf {
  std::uint64_t task = 0;  ///< its id
  std::uint64_t sequence = 0;
  friend auto operator<=>(const EventOf&, const EventOf&) = default;
};

inline EventOf event_of(const kernel::Task& task) { return {task.id, task.sequence}; }

/// In place of `usual`, the next event of some task, comes `instead`; or what `usual` chooses is number `instead.task`.
struct Switch {
  kernel::Choice choice = kernel::Choice::task;
  EventOf usual;
  EventOf instead;
  friend auto operator<=>(const Switch&, const Switch&) = default;
};

struct Decision {
  std::uint32_t count;   ///< alternatives, at least two
  std::uint32_t chosen;  ///< below count
  std::uint32_t usual;   ///< what the default order would have chosen
  kernel::Choice choice = kernel::Choice::task;
  bool may_go_on = false;      ///< the usual one is the task whose event was executed last: another preempts it
  std::uint64_t spinning = 0;  ///< of the first 64 alternatives: tasks that spin, whose turn it is not

  bool is_switch() const { return chosen != usual; }
  bool spins(std::uint32_t alternative) const { return alternative < 64 && (spinning >> alternative & 1) != 0; }
};

/// At which decision of a schedule, counted from 0, which alternative.
struct Deviation {
  std::uint32_t decision;
  std::uint32_t chosen;
  friend bool operator==(const Deviation&, const Deviation&) = default;
};

struct Schedule {
  std::vector<Decision> decisions;
  std::vector<Switch> switches;  ///< of those decisions that are switches, in their order

  /// The switches by their numbers: shorter, and only of use in a program that is not edited.
  std::vector<Deviation> deviations() const {
    std::vector<Deviation> found;
    for (std::size_t i = 0; i < decisions.size(); ++i)
      if (decisions[i].is_switch()) found.push_back({static_cast<std::uint32_t>(i), decisions[i].chosen});
    return found;
  }
};

}  // namespace waitpoint::exploration
