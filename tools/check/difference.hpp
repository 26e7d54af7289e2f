// SPDX-License-Identifier: BSD-3-Clause
// Where two runs part: the first event that one has and the other has not.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/time.hpp"

namespace waitpoint::tools {

/// One event of a run, by names.
struct LoggedEvent {
  Time time;
  std::string robot, task, operation, object;  ///< the object is empty where there is none
  std::uint64_t digest = 0;                    ///< of the robot, up to and with this event
  friend bool operator==(const LoggedEvent&, const LoggedEvent&) = default;
};

/// "12.500000000 s, robot rackham, task ndd.motion: release semaphore#25 "mailbox event"".
std::string to_string(const LoggedEvent& event);

struct Difference {
  std::uint64_t number = 0;                    ///< of the event among all of the run, from 1
  std::optional<LoggedEvent> expected, found;  ///< of the first run, and of this one; absent: it had no further event
  std::string expected_end, found_end;         ///< how a run without further event ended
  std::optional<LoggedEvent> before;           ///< the last event of the same robot, equal in both
};

/// In some lines, each indented by two spaces: the event, what it was in both runs, what differs, what came before.
std::string to_text(const Difference& difference);

}  // namespace waitpoint::tools
