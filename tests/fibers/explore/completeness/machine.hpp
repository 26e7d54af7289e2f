// SPDX-License-Identifier: BSD-3-Clause
// All outcomes that a program can have, by exhaustive search over the states of an abstract machine. Independent of the
// kernel and of the strategies: it states the semantics that they must have.
//
// An event is one instruction of one thread, or its end; creations, skips and the start of a sleep belong to the event
// before. At an instant the events of all threads that are neither blocked nor asleep happen in every order; time
// passes when none is left. An unlock, or the release of a unit, hands the mutex or the unit directly to one of the
// waiters, to each in turn. A cycle of threads that wait for mutexes and ends of threads ends the run as it closes.
#pragma once

#include <set>
#include <string>

#include "tests/fibers/explore/completeness/program.hpp"

namespace waitpoint::completeness {

/// The end of a run, as text:
///
///   ended: 0[1 0] 1[] memory 2 0        all threads ended; what each read, and the atomics
///   stuck {0 1}: 0[1 0] ...             the same, but these threads are blocked for ever
///   cycle {0 1}: 0[1] 1[]               these threads wait for each other
///   exit 1: 1[0]                        thread 1 ended the program
///   misuse 0: 0[1]                      thread 0 misused a primitive, or ended while it held a mutex
///
/// Of a run that is ended only what the threads named had read belongs to the outcome: the others may be anywhere.
using Outcomes = std::set<std::string>;

/// What the threads of a finished run have read, and where it left the atomics.
struct Observed {
  std::vector<std::vector<int>> reads;  ///< by thread
  std::vector<int> values;
};

/// The text of an outcome: `end` is one of the words above. `threads` are those that it names, in ascending order.
std::string outcome(const std::string& end, const std::vector<std::size_t>& threads, const Observed& observed);

/// All outcomes of `program`; nothing if it has more than `states_max` states.
struct Enumerated {
  Outcomes outcomes;
  std::size_t states = 0;
  bool is_complete = true;
};
Enumerated enumerate(const Program& program, std::size_t states_max);

}  // namespace waitpoint::completeness
