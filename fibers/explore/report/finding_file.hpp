// SPDX-License-Identifier: BSD-3-Clause
// A finding as a file, for a page: a failing schedule beside the nearest passing one, with the two events whose order
// matters and their call stacks. One object of JSON, in the form of a recorded run of the browser's page, with
//
//   "finding"  format, schedule, failure, choice, note, replay and debug (commands), steps and report, as texts
//   "marks"    {line, pair, words, frames}: an event of the pair in one of the schedules, 0 the failing one; its number
//              there is that of "marked" in the schedule's events
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace waitpoint::exploration {

/// An event that a schedule is about to execute, with its task's call stack.
struct FindingEvent {
  std::string words;               ///< "at 0.010000000 s: a#1, about to lock mutex #1"
  std::vector<std::string> calls;  ///< "function at file:line", innermost first
};

struct FindingSchedule {
  std::string events;       ///< to_columns(), with the pair marked
  std::string frames = {};  ///< of the floor, separated by commas; empty: none
  /// First in the failing schedule, first in the passing one; nothing for an event that does not happen.
  std::array<std::optional<FindingEvent>, 2> pair = {};
};

struct FindingFile {
  std::string title;         ///< of the test, the scenario or the program
  std::string version = {};  ///< of waitpoint
  std::uint64_t seed = 0;
  std::string schedule = {};  ///< "schedule 2 of strategy portfolio, seed 1"
  std::string failure = {};   ///< its first line is the headline
  std::string choice = {};    ///< the last one from which it could still have passed; empty: not known
  std::string note = {};      ///< where there is no pair of events: why
  std::string replay = {}, debug = {};
  std::string steps = {};   ///< the last events of the tasks
  std::string report = {};  ///< the whole text
  std::string scene = {};   ///< the head of a page with a floor, as JSON; empty: without
  FindingSchedule fails = {};
  std::optional<FindingSchedule> passes = {};
};

std::string to_text(const FindingFile& finding);

}  // namespace waitpoint::exploration
