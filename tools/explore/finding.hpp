// SPDX-License-Identifier: BSD-3-Clause
// What one schedule of a scenario came to. It is made in a process of its own and goes through a pipe: as bytes of one
// program to the same program.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"
#include "fibers/explore/report/narrator.hpp"
#include "fibers/explore/report/timeline.hpp"
#include "fibers/explore/schedules/event_log.hpp"
#include "fibers/explore/strategies/profile.hpp"
#include "fibers/explore/strategies/schedule.hpp"

namespace waitpoint::tools {

struct Finding {
  enum class Kind : std::uint8_t { passed, unmet, deadlock, no_progress, exception, killed };

  Kind kind = Kind::passed;
  std::string words;         ///< of a failure: what happened, its first line in short
  std::uint64_t digest = 0;  ///< 0: not known, as the process was killed
  Time end;                  ///< when it was over, or known to have failed
  std::uint64_t events = 0;
  std::uint64_t decisions = 0;
  std::vector<exploration::Switch> switches;       ///< of a failure
  std::vector<exploration::Deviation> deviations;  ///< the same
  std::vector<exploration::Decision> choices;      ///< where asked for: all
  bool parted = false;                             ///< what was played did not fit the run
  std::string details;                             ///< of a failure, where places are asked for: lines about its kind
  std::string told;                                ///< where asked for: the switches in words, a decision or an event
  std::string last_events;                         ///< where asked for, in words
  std::string trace;                               ///< where asked for
  std::vector<exploration::DoneEvent> log;         ///< where asked for
  std::string trail;                               ///< where asked for
  exploration::Profile profile;                    ///< where asked for

  bool passed() const { return kind == Kind::passed; }
  /// Takes over what was chosen; of a failure, how it repeats.
  void take(const exploration::Explorer& explorer);
  /// Takes over the decision that was asked for, or with `switches_too` the switches in words.
  void tell(const exploration::Narrator& narrator, bool decision_asked, bool switches_too);
  /// Takes over what the tasks did.
  void tell(const exploration::Timeline& timeline, bool trace_too);
  /// Takes over the event before which the run was to end, with the calls that its task was in.
  void tell(const std::string& event, const std::vector<std::string>& calls);
  /// "2 collisions, expected 0".
  std::string headline() const { return words.substr(0, words.find('\n')); }
};

/// Whether both failed in the same way: in the same words, but for numbers, which differ from schedule to schedule.
bool is_same_failure(const Finding& a, const Finding& b);

std::string to_bytes(const Finding& finding);
/// Of what to_bytes() wrote, whole.
Finding finding_of(std::string_view bytes);
/// "wp1:0123456789abcdef".
std::string digest_text(std::uint64_t digest);

}  // namespace waitpoint::tools
