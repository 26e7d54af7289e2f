// SPDX-License-Identifier: BSD-3-Clause
// The result of one schedule of a target: a verdict of fixed size for the loop of a search; for a failure its words and
// its switches; and the evidence that was wanted, made when the schedule is repeated for it (wanted_evidence.hpp).
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "fibers/explore/races/races.hpp"
#include "fibers/explore/schedules/event_log.hpp"
#include "fibers/explore/strategies/profile.hpp"
#include "fibers/explore/strategies/reads_from.hpp"
#include "fibers/explore/strategies/schedule.hpp"
#include "fibers/explore/strategies/switch_points.hpp"

namespace waitpoint::exploration {

struct RunVerdict {
  /// By rank, the least grave first: a run that fails in several ways is of the gravest kind.
  enum class Kind : std::uint8_t { passed, race, misuse, no_progress, deadlock, unmet, exception, crash, killed };

  Kind kind = Kind::passed;
  bool was_cut = false;                ///< abandoned: its rest is equivalent to others'; it counts as passed
  bool is_beyond_enumeration = false;  ///< as in Explorer
  bool cuts_polls_short = false;       ///< as in Schedule
  bool has_unlearned_code = false;     ///< first accesses to shared memory were no switch points; if choices are wanted
  bool has_left_out_values = false;    ///< a load was not offered a value that it may have returned
  bool uses_futexes = false;           ///< the program's own locks are atomics, which are events at accesses only
  bool meets_outside = false;          ///< the run depends on what is not simulated
  bool has_raced = false;              ///< with data races, even if it is not a failure
  bool parted = false;                 ///< the plan did not fit the run
  SwitchAt switch_at = SwitchAt::automatic;        ///< of a program that is not instrumented: calls or accesses
  AccessObstacle obstacle = AccessObstacle::none;  ///< why it has calls in place of accesses
  std::uint64_t digest = 0;                        ///< 0: unknown, the process was killed
  std::uint64_t order = 0;  ///< equal for runs that differ in nothing but the order of independent events
  Time end = {};            ///< when the run ended, or its failure was certain
  std::uint64_t events = 0, decisions = 0;
  std::uint64_t generated_code = 0;  ///< bytes of code made at run time, whose accesses are no switch points
  std::uint64_t libraries = 0;       ///< with accesses as switch points: a bit for each that is watched

  bool passed() const { return kind == Kind::passed; }
};

/// A race's two places of code, as hashes that are the same in all runs, the lesser one first.
struct RacingCode {
  std::uint64_t first, second;

  auto operator<=>(const RacingCode&) const = default;
};

/// A race in words.
struct ToldRace {
  std::string lines;     ///< of its accesses, which identify it
  std::string headline;  ///< in one line
  std::string text;      ///< several lines
};

/// `process`: its name, where there are several.
ToldRace told(const races::Race& race, const std::string& process = "");

/// What a search derives further schedules from.
struct Lesson {
  std::vector<Decision> choices;        ///< all of them
  std::vector<ReadsFrom> pairs;         ///< those of the run's first process
  std::vector<std::uint64_t> progress;  ///< of dpor, with the choices: the search so far; empty with several processes
  Profile profile = {};
};

/// What a report says of a run.
struct Evidence {
  std::vector<ToldRace> races;  ///< with the places, or new to the process
  std::string details;          ///< of a failure, with the places: lines specific to its kind
  std::string told;             ///< the switches, a decision or an event, in words
  std::string system_calls;     ///< with the profile: warnings of calls that leave virtual time
  std::string last_events;      ///< in words
  std::string cause;            ///< cause_in_words()
  std::string trace;            ///< for Chrome and Perfetto
  std::string columns;          ///< of a page: to_columns()
  std::string scene, frames;    ///< the same, of a scenario: its floor, as JSON
  std::string trail;
  std::vector<DoneEvent> log;
};

struct Finding : RunVerdict {
  std::string words;                  ///< the failure; its first line is the headline
  std::vector<RacingCode> racing;     ///< of its data races, whatever its kind
  std::vector<Switch> switches;       ///< of a failure
  std::vector<Deviation> deviations;  ///< the same switches
  Lesson lesson;
  Evidence evidence;

  /// Copies the number of choices, and of a failure the switches.
  void take(const Schedule& schedule, bool has_parted);
  /// "2 collisions, expected 0".
  std::string headline() const { return words.substr(0, words.find('\n')); }
};

/// True if both failed in the same way: deadlocks and lacks of progress, whose places and times differ from schedule to
/// schedule; races of the same code; others with the same headline, ignoring the task, the time and numbers other than
/// those of source lines.
bool is_same_failure(const Finding& a, const Finding& b);

}  // namespace waitpoint::exploration
