// SPDX-License-Identifier: BSD-3-Clause
// The first difference of two runs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/time.hpp"

namespace waitpoint::tools {

/// One event of a run, with names instead of numbers.
struct LoggedEvent {
  Time time;
  std::string robot, task, operation, object;  ///< the object may be empty
  std::uint64_t digest = 0;                    ///< of the robot, including this event
  friend bool operator==(const LoggedEvent&, const LoggedEvent&) = default;
};

/// "12.500000000 s, robot rackham, task ndd.motion: release semaphore#25 "mailbox event"".
std::string to_string(const LoggedEvent& event);

struct Difference {
  std::uint64_t number = 0;                    ///< of the event in the run, from 1
  std::optional<LoggedEvent> expected, found;  ///< of the first run, and of this one; absent: it had no further event
  std::string expected_end, found_end;         ///< the end of a run without a further event
  std::optional<LoggedEvent> before;           ///< the last event of the same robot, equal in both
};

/// Several lines, indented by two spaces: the event's number, the event in both runs, the differing fields, the
/// previous event.
std::string to_text(const Difference& difference);

/// The same as an object of JSON.
std::string to_json(const Difference& difference);

}  // namespace waitpoint::tools
