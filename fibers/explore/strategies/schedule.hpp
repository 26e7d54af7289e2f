// SPDX-License-Identifier: BSD-3-Clause
// A schedule as a sequence of choices: it is replayed, minimised and stored in this form.
//
// Only real choices are in it: those with two or more alternatives. The default one is that of the default order: the
// running task continues, else the one that has been ready longest, of those that do not spin; the first waiter; the
// longest computation. The deviations from it, the switches, are identified by tasks and their events: so they remain
// valid when others are left out, or the code around them is edited.
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

/// Instead of `usual`, the next event of some task, event `instead` executes; in other choices, the task of `usual`
/// takes alternative `instead.task`; in choices among processes for the time `instead.sequence`, from 0 on, that its
/// process chooses before this event.
struct Switch {
  kernel::Choice choice = kernel::Choice::task;
  EventOf usual;
  EventOf instead;
  friend auto operator<=>(const Switch&, const Switch&) = default;
};

struct Decision {
  std::uint32_t count;   ///< alternatives, at least two
  std::uint32_t chosen;  ///< below count
  std::uint32_t usual;   ///< the default choice
  kernel::Choice choice = kernel::Choice::task;
  bool can_continue = false;   ///< the default one is the task of the last event: choosing another preempts it
  std::uint64_t spinning = 0;  ///< spinning tasks among the first 64 alternatives, not offered

  bool is_switch() const { return chosen != usual; }
  bool spins(std::uint32_t alternative) const { return alternative < 64 && (spinning >> alternative & 1) != 0; }
};

/// The number of a decision in a schedule, counted from 0, and its alternative.
struct Deviation {
  std::uint32_t decision;
  std::uint32_t chosen;
  friend bool operator==(const Deviation&, const Deviation&) = default;
};

struct Schedule {
  std::vector<Decision> decisions;
  std::vector<Switch> switches;   ///< the decisions that are switches, in order
  bool cuts_polls_short = false;  ///< time has advanced although tasks could have polled on at their instant

  /// The switches by decision numbers: shorter, but only valid in the unedited program.
  std::vector<Deviation> deviations() const {
    std::vector<Deviation> found;
    for (std::size_t i = 0; i < decisions.size(); ++i)
      if (decisions[i].is_switch()) found.push_back({static_cast<std::uint32_t>(i), decisions[i].chosen});
    return found;
  }
};

}  // namespace waitpoint::exploration
