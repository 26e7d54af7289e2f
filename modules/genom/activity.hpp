// SPDX-License-Identifier: BSD-3-Clause
// Activities: executions of requests, as the small state machine that GenoM runs for each.
//
//            +--------+     +-------+     +------+
//   INIT --> | START  | --> | EXEC  | --> | END  | --> ETHER (ended: final reply, slot free)
//            +--------+     +-------+     +------+
//               |  \interrupt / |  ^         |
//               |   v        v  |  | SLEEP   |
//               |  +--------+   |  +---------|
//               |  | INTER  | --|------------|--> ETHER, always with report ACTIVITY_INTERRUPTED
//               |  +--------+   |            |
//               +--> FAIL <-----+------------+ --> ZOMBIE (failed: final reply with its own report or
//                                                  ACTIVITY_FAILED; keeps its slot, and blocks further execution
//                                                  requests, until an Abort frees it)
//
// One codel is called per wake-up of the activity's execution task; the state it returns comes next. A codel that is
// not given counts as one that returns the default at once: START->EXEC, EXEC->END, END->ETHER, FAIL->ZOMBIE,
// INTER->ETHER. The allowed results are those of GenoM's execTask.c.
#pragma once

#include <cstdint>

#include "modules/genom/mailbox.hpp"

namespace waitpoint::genom {

enum class State : std::uint8_t { ether, init, start, exec, end, fail, inter, zombie, sleep };

constexpr const char* name(State state) {
  constexpr const char* names[] = {"ETHER", "INIT", "START", "EXEC", "END", "FAIL", "INTER", "ZOMBIE", "SLEEP"};
  return names[static_cast<int>(state)];
}

/// Whether the codel of state `from` may return `to`.
constexpr bool allowed(State from, State to) {
  const auto one_of = [to](auto... states) { return ((to == states) || ...); };
  switch (from) {
    case State::start:
      return one_of(State::start, State::exec, State::sleep, State::end, State::ether, State::fail, State::zombie);
    case State::exec: return one_of(State::exec, State::sleep, State::end, State::ether, State::fail, State::zombie);
    case State::end: return one_of(State::end, State::ether, State::fail, State::zombie);
    case State::inter: return one_of(State::inter, State::ether, State::fail, State::zombie);
    case State::fail: return to == State::zombie;
    default: return false;
  }
}

/// What follows a state whose codel is not given.
constexpr State default_after(State state) {
  switch (state) {
    case State::start: return State::exec;
    case State::exec: return State::end;
    case State::fail: return State::zombie;
    default: return State::ether;
  }
}

struct RequestType;

inline constexpr std::size_t activities_max = 19;  // SERV_NMAX_RQST_ID - 1

/// Guarded by the lock on the control data.
struct Activity {
  State state = State::ether;  ///< ETHER: ended, its final reply still to be sent
  bool replied = false;        ///< its final reply is sent: of a ZOMBIE
  bool interrupt = false;      ///< told to go to INTER
  bool interrupted = false;    ///< went there: whatever its codels say, it ends with report ACTIVITY_INTERRUPTED
  const RequestType* type = nullptr;
  std::int32_t number = -1;
  std::uint32_t send_id = 0;
  Mailbox* client = nullptr;
  Report report = ok;
  Payload input;
  Payload output;
};

}  // namespace waitpoint::genom
