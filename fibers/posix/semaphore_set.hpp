// SPDX-License-Identifier: BSD-3-Clause
// Sets of System V semaphores: a call's operations on the semaphores of a set are done all at once or not at all. Who
// changes a set does on the spot what waiting calls can do then.
#pragma once

#include <sys/sem.h>

#include <cstdlib>

#include "fibers/posix/program_state.hpp"
#include "fibers/posix/system_v.hpp"

namespace waitpoint::posix::system_v {

// Linux's, as it is when a machine starts.
inline constexpr int sets_max = 32000, semaphores_a_set_max = 32000, operations_a_call_max = 500, value_max = 32767;

struct Value {
  unsigned short value;
  pid_t last;  ///< who changed it last
};

/// A call that waits for its operations to be possible: on its thread's stack.
struct Waiting {
  kernel::Task* task;
  const sembuf* operations;
  std::size_t count;
  const sembuf* hindered_by;  ///< the first that cannot be done
  int result;                 ///< an error, or 0
  bool done;
  Waiting* next;
};

/// What a program has done with SEM_UNDO to a set, negated.
struct Adjustments {
  const Program* program;
  Adjustments* next;
  int* by;  ///< behind it
};

struct Set : Common {
  Set() : Common("System V semaphores") {}
  ~Set() {
    while (Adjustments* first = adjustments) {
      adjustments = first->next;
      std::free(first);
    }
  }

  int size = 0;
  Value* values = nullptr;  ///< behind it
  time_t operated = 0, changed = 0;
  Waiting* first = nullptr;
  Adjustments* adjustments = nullptr;
};

extern Table<Set, sets_max> sets;

/// As semop(), until a deadline of virtual time.
int operate(int id, const sembuf* operations, std::size_t count, Time deadline);
/// After a change: calls that can go on now do, one after the other.
void let_go_on(Set& set);
/// All calls that wait end with this error.
void end_all(Set& set, int error);

}  // namespace waitpoint::posix::system_v
