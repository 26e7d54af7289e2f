// SPDX-License-Identifier: BSD-3-Clause
// Sets of System V semaphores: a call's operations on the semaphores of a set are done all at once or not at all. Who
// changes a set does on the spot what waiting calls can do then.
#pragma once

#include <sys/sem.h>

#include "fibers/posix/ipc/system_v.hpp"
#include "fibers/posix/program/program_state.hpp"

namespace waitpoint::posix::system_v {

// Linux's, as it is when a machine starts.
inline constexpr int sets_max = 32000, semaphores_a_set_max = 32000, operations_a_call_max = 500, value_max = 32767;

struct Value {
  unsigned short value;
  pid_t last;  ///< who changed it last
};

/// Whose call it is.
struct Caller {
  pid_t process;
  const Program* program;
  bool operator==(const Caller&) const = default;
};

/// A call that waits for its operations to be possible, of any process of the family.
struct Waiting {
  Caller caller;
  kernel::Task* task;  ///< in its process
  std::size_t count;
  std::size_t hindered_by;  ///< the first that cannot be done
  int result;               ///< an error, or 0
  bool done;
  Waiting* next;
  sembuf* operations() { return reinterpret_cast<sembuf*>(this + 1); }
  const sembuf& hindering() { return operations()[hindered_by]; }
};

/// What a program has done with SEM_UNDO to a set, negated.
struct Adjustments {
  Caller of;
  Adjustments* next;
  int* by;  ///< behind it
};

struct Set : Common {
  Set() : Common("System V semaphores") {}
  ~Set() {
    while (Adjustments* first = adjustments) {
      adjustments = first->next;
      family::give(first);
    }
  }

  int size = 0;
  Value* values = nullptr;  ///< behind it
  time_t operated = 0, changed = 0;
  Waiting* first = nullptr;
  Adjustments* adjustments = nullptr;
};

using Sets = Table<Set, sets_max>;
/// Within the family's section, as all that follows.
inline Sets& sets() { return table_of<Sets>(family::Part::semaphores); }

/// After a change: calls that can go on now do, one after the other.
void let_go_on(Set& set);
/// All calls that wait end with this error.
void end_all(Set& set, int error);
/// What processes that have ended had done with SEM_UNDO is taken back; whether there was any.
bool undo_of_ended(Set& set);

/// As semop(), until a deadline of virtual time. Outside the section.
int operate(int id, const sembuf* operations, std::size_t count, Time deadline);

}  // namespace waitpoint::posix::system_v
