// SPDX-License-Identifier: BSD-3-Clause
// Sets of System V semaphores: a call's operations on a set are done all at once or not at all. A call that changes a
// set also completes the waiting calls that have become possible.
#pragma once

#include <sys/sem.h>

#include <climits>

#include "fibers/posix/ipc/system_v.hpp"
#include "fibers/posix/program/program_state.hpp"

namespace waitpoint::posix::system_v {

// Linux's defaults.
inline constexpr int sets_max = 32000, semaphores_a_set_max = 32000, operations_a_call_max = 500, value_max = 32767;
static_assert(value_max <= USHRT_MAX && semaphores_a_set_max <= USHRT_MAX, "Value and sembuf have unsigned shorts");

struct Value {
  unsigned short value;
  pid_t last;  ///< the process that changed it last
};

/// The process and program of a call.
struct Caller {
  pid_t process;
  const Program* program;
  bool operator==(const Caller&) const = default;
};

/// A call that waits for its operations to be possible, of any process of the family.
struct Waiting {
  Caller caller;
  kernel::Task* task;  ///< valid in its own process only
  std::size_t count;
  std::size_t hindered_by;  ///< index of the first operation that cannot be done
  int result;               ///< an error, or 0
  bool done;
  Waiting* next;
  sembuf* operations() { return reinterpret_cast<sembuf*>(this + 1); }
  const sembuf& hindering() {
    WAITPOINT_CHECK(hindered_by < count, "a call is hindered by an operation that it does not have");
    return operations()[hindered_by];
  }
};

static_assert(alignof(sembuf) <= alignof(Waiting), "a call's operations are behind it");

/// The negated sum of a program's SEM_UNDO operations on a set.
struct Adjustments {
  Caller of;
  Adjustments* next;
  int* by;  ///< one for each semaphore, behind this struct
};

static_assert(alignof(int) <= alignof(Adjustments), "the adjustments' numbers are behind them");

struct Set : Common {
  Set() : Common("System V semaphores") {}
  ~Set() {
    while (Adjustments* first = adjustments) {
      adjustments = first->next;
      family::give(first);
    }
  }

  int size = 0;
  Value* values = nullptr;  ///< behind this struct
  time_t operated = 0, changed = 0;
  Waiting* first = nullptr;
  Adjustments* adjustments = nullptr;
};

static_assert(alignof(Value) <= alignof(Set), "a set's values are behind it");

using Sets = Table<Set, sets_max>;
inline Sets& sets() { return table_of<Sets>(family::Part::semaphores); }

/// After a change: completes the waiting calls that have become possible, one after the other.
void let_go_on(Set& set);
/// Ends all waiting calls with this error.
void end_all(Set& set, int error);
/// Reverts the SEM_UNDO operations of processes that have ended. True if there were any.
bool undo_of_ended(Set& set);

/// As semop(), until a deadline of virtual time.
int operate(int id, const sembuf* operations, std::size_t count, Time deadline);

}  // namespace waitpoint::posix::system_v
