// SPDX-License-Identifier: BSD-3-Clause
// Activities: requests under execution, each with the state machine that GenoM gives it.
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
// Each wake-up of the activity's execution task calls one codel, which returns the next state. A missing codel passes
// at once to the default: START->EXEC, EXEC->END, END->ETHER, FAIL->ZOMBIE, INTER->ETHER. The allowed transitions are
// those of GenoM's execTask.c.
#pragma once

#include <cstdint>

#include "modules/genom/mailbox.hpp"

namespace waitpoint::genom {

enum class State : std::uint8_t { ether, init, start, exec, end, fail, inter, zombie, sleep };

constexpr const char* name(State state) {
  constexpr const char* names[] = {"ETHER", "INIT", "START", "EXEC", "END", "FAIL", "INTER", "ZOMBIE", "SLEEP"};
  return names[static_cast<int>(state)];
}

/// The codel that is called in a state, for reports.
constexpr const char* codel_name(State state) {
  constexpr const char* names[] = {"no codel",   "no codel",    "codel start", "codel exec", "codel end",
                                   "codel fail", "codel inter", "no codel",    "no codel"};
  return names[static_cast<int>(state)];
}

/// True if the codel of state `from` may return `to`.
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

/// The next state after one without a codel.
constexpr State default_after(State state) {
  switch (state) {
    case State::start: return State::exec;
    case State::exec: return State::end;
    case State::fail: return State::zombie;
    default: return State::ether;
  }
}

struct RequestType;

inline constexpr std::size_t activities_max = 19;  // GenoM's SERV_NMAX_RQST_ID - 1

/// One slot of the table. Guarded by the lock on the control data.
struct Activity {
  State state = State::ether;  ///< ETHER: ended, final reply not sent yet
  bool replied = false;        ///< of a ZOMBIE: final reply sent
  bool interrupt = false;      ///< goes to INTER at the next wake-up
  bool interrupted = false;    ///< has been in INTER: ends with report ACTIVITY_INTERRUPTED, whatever its codels set
  const RequestType* type = nullptr;
  std::int32_t number = -1;
  std::uint32_t send_id = 0;
  Mailbox* client = nullptr;
  Report report = ok;
  Payload input;
  Payload output;
};

}  // namespace waitpoint::genom
