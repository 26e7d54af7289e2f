// SPDX-License-Identifier: BSD-3-Clause
// All outcomes that a program can have, by exhaustive search over the states of an abstract machine. Independent of the
// kernel and of the strategies: it states the semantics that they must have.
//
// An event is one instruction of one thread, or its end; creations, skips and the start of a sleep belong to the event
// before. At an instant the events of all threads that are neither blocked nor asleep happen in every order; time
// passes when none is left. An unlock, or the release of a unit, hands the mutex or the unit directly to one of the
// waiters, to each in turn. A cycle of threads that wait for mutexes and ends of threads ends the run as it closes.
#pragma once

#include "tests/fibers/explore/completeness/outcome.hpp"
#include "tests/fibers/explore/completeness/program.hpp"

namespace waitpoint::completeness {

/// All outcomes of `program`; nothing if it has more than `states_max` states.
struct Enumerated {
  Outcomes outcomes;
  std::size_t states = 0;
  bool is_complete = true;
};
Enumerated enumerate(const Program& program, std::size_t states_max);

}  // namespace waitpoint::completeness
