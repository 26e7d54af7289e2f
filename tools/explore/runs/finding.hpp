// SPDX-License-Identifier: BSD-3-Clause
// The result of one schedule. Computed in a process of its own and sent through a pipe, from a program to itself, as
// bytes.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"
#include "fibers/explore/report/narrator.hpp"
#include "fibers/explore/report/timeline.hpp"
#include "fibers/explore/schedules/event_log.hpp"
#include "fibers/explore/strategies/profile.hpp"
#include "fibers/explore/strategies/reads_from.hpp"
#include "fibers/explore/strategies/schedule.hpp"
#include "fibers/posix/traps/access_obstacle.hpp"
#include "tools/exec/switch_at.hpp"

namespace waitpoint::tools {

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

struct Finding {
  /// By rank, the least grave first: a run that fails in several ways is of the gravest kind.
  enum class Kind : std::uint8_t { passed, race, misuse, no_progress, deadlock, unmet, exception, crash, killed };

  Kind kind = Kind::passed;
  std::string words;         ///< the failure; its first line is the headline
  std::uint64_t digest = 0;  ///< 0: unknown, the process was killed
  Time end;                  ///< when the run ended, or its failure was certain
  std::uint64_t events = 0;
  std::uint64_t decisions = 0;
  std::vector<exploration::Switch> switches;       ///< for failures
  std::vector<exploration::Deviation> deviations;  ///< the same switches
  std::vector<exploration::Decision> choices;      ///< if requested: all of them
  std::uint64_t order = 0;             ///< equal for runs that differ in nothing but the order of independent events
  bool is_beyond_enumeration = false;  ///< as in exploration::Explorer
  std::vector<exploration::ReadsFrom> pairs;  ///< if requested: those of the run's first process
  std::vector<std::uint64_t> progress;  ///< of dpor with the choices: the search after it; empty with several processes
  bool was_cut = false;                 ///< dpor has ended it before its end: its rest is equivalent to others'
  bool cuts_polls_short = false;        ///< as in exploration::Schedule
  bool has_unlearned_code = false;  ///< its first accesses to shared memory were no switch points; if choices are asked
  bool has_left_out_values = false;          ///< a load was not offered a value that it may have returned
  SwitchAt switch_at = SwitchAt::automatic;  ///< of a program that is not instrumented: calls or accesses
  posix::AccessObstacle obstacle = posix::AccessObstacle::none;  ///< why it has calls in place of accesses
  bool parted = false;                                           ///< the plan did not fit the run
  std::vector<RacingCode> racing;                                ///< of its data races, whatever its kind
  std::vector<ToldRace> races;              ///< the same in words, if places are requested, or new to the process
  std::string details;                      ///< for failures, if places are requested: lines specific to the kind
  std::string told;                         ///< if requested: the switches, a decision or an event, in words
  std::string system_calls;                 ///< with the profile: warnings of calls that leave virtual time
  std::string last_events;                  ///< if requested, in words
  std::string trace;                        ///< if requested
  std::string columns;                      ///< for a page, if requested: exploration::to_columns()
  std::string scene, frames;                ///< the same, of a scenario: its floor, as JSON
  std::vector<exploration::DoneEvent> log;  ///< if requested
  std::string trail;                        ///< if requested
  exploration::Profile profile;             ///< if requested

  bool passed() const { return kind == Kind::passed; }
  /// Copies the choices, and for a failure its switches.
  void take(const exploration::Schedule& schedule, bool has_parted);
  /// Copies the requested decision, or with `switches_too` the switches in words.
  void tell(const exploration::Narration& narration, bool decision_asked, bool switches_too);
  /// Copies the tasks' events, as a trace or in columns, too, if wanted.
  struct TimelineForms {
    bool trace = false, columns = false;
    std::span<const exploration::EventOf> marked = {};  ///< in the columns
  };
  void tell(const exploration::Timeline& timeline, const TimelineForms& forms);
  /// Copies the event before which the run was to end, with its task's call stack.
  void tell(const std::string& event, const std::vector<std::string>& calls);
  /// "2 collisions, expected 0".
  std::string headline() const { return words.substr(0, words.find('\n')); }
};

/// True if both failed in the same way: with the same words, ignoring numbers, which differ from schedule to schedule,
/// or by races of the same code.
bool is_same_failure(const Finding& a, const Finding& b);

std::string to_bytes(const Finding& finding);
/// Parses the complete output of to_bytes().
Finding finding_of(std::string_view bytes);
/// "wp1:0123456789abcdef".
std::string digest_text(std::uint64_t digest);

}  // namespace waitpoint::tools
