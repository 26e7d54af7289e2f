// SPDX-License-Identifier: BSD-3-Clause
// What is recorded of a run besides its verdict: see Lesson and Evidence in finding.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/time.hpp"
#include "fibers/explore/report/cause.hpp"
#include "fibers/explore/strategies/schedule.hpp"

namespace waitpoint::exploration {

/// The last events of the tasks.
struct WantedEvents {
  Time from = {};
  bool trace = false;  ///< also as a trace
  bool page = false;   ///< also in columns, and of a scenario the floor
  std::uint32_t marked_count = 0;
  std::array<EventOf, 2> marked = {};      ///< in the columns: so many of these
  std::optional<FailureOrder> cause = {};  ///< the cause is wanted

  std::span<const EventOf> marks() const { return std::span(marked).first(marked_count); }
};

struct WantedEvidence {
  bool profile = false;
  bool learn = false;      ///< for the profile: code that accesses memory shared by tasks
  bool conflicts = false;  ///< of a program that is not instrumented: unordered accesses to memory, as races
  bool choices = false;    ///< all choices made
  bool pairs = false;      ///< the reads-from relation, of the first process
  bool words = false;      ///< switches in words
  bool places = false;     ///< source locations of the tasks in reports
  std::optional<WantedEvents> events = {};
  std::optional<std::size_t> decision = {};   ///< the choice made there, in words
  std::optional<std::uint32_t> instead = {};  ///< with it, not of a program: also this alternative to it
  std::optional<std::size_t> log_from = {};   ///< the events after this decision
  std::optional<std::uint32_t> trail = {};    ///< of a scenario or a body: a mark after each 2^N events
  /// Ends the run before this event; its task's next operation and call stack in words.
  std::optional<EventOf> stop_before = {};
};

}  // namespace waitpoint::exploration
