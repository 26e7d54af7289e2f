// SPDX-License-Identifier: BSD-3-Clause
//
// pthread_cond_t: the program's object holds a pointer to the waitable, and the clock of the deadlines.
#include <pthread.h>

#include <cerrno>
#include <cstring>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/sync/mutex.hpp"
#include "fibers/posix/sync/shared_object.hpp"
#include "fibers/posix/time/clocks.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::posix {
namespace {

struct Condition : Waitable {
  static constexpr Kind kind_of_all = Kind::condition;
  explicit Condition(const void* address) : Waitable(kind_of_all, "condition variable", address) {}

  kernel::Object last_leaves{"end of a condition variable"};  ///< for who destroys it
  std::uint32_t inside = 0;                                   ///< calls in their wait, of a private one
  const Mutex* mutex = nullptr;                               ///< of the last wait
};
static_assert(sizeof(Condition) <= waitable_bytes_max);

struct ConditionBytes : SharedBytes<Condition> {
  clockid_t clock;  // 0: CLOCK_REALTIME
  // If processes share it: each waiter has a ticket, and those below `released` continue.
  std::uint64_t next_ticket;
  std::uint64_t released;
  std::uint32_t changes;
  std::uint32_t inside;  // calls in their wait
};
static_assert(sizeof(ConditionBytes) <= sizeof(pthread_cond_t));
static_assert(alignof(ConditionBytes) <= alignof(pthread_cond_t));
static_assert(!CLOCK_REALTIME, "PTHREAD_COND_INITIALIZER is all zeroes");

ConditionBytes& bytes_of(pthread_cond_t* condition) { return *reinterpret_cast<ConditionBytes*>(condition); }

std::uint64_t take_ticket(ConditionBytes& bytes) { return bytes.next_ticket++; }

// A wait that ends without a signal leaves an unused ticket. Unless that is the newest, all waiters wake: spuriously,
// as POSIX allows, but no signal is lost.
void give_ticket_back(ConditionBytes& bytes, std::uint64_t ticket) {
  if (ticket < bytes.released) return;
  if (ticket + 1 == bytes.next_ticket)
    --bytes.next_ticket;
  else
    bytes.released = bytes.next_ticket;
  ++bytes.changes;
}

Wait wait_shared(Condition& known, ConditionBytes& bytes, std::uint64_t ticket, Time deadline,
                 const CancellationPoint& point) {
  for (;;) {
    std::uint32_t changes = 0;
    {
      if (ticket < bytes.released) return Wait::came;
      changes = bytes.changes;
    }
    Wait ended = Wait::interrupted;
    if (!point.was_cancelled())
      ended = deadline > kernel::running->local_time ? wait_for_change(known.object, bytes.changes, changes, deadline)
                                                     : Wait::timed_out;
    if (ended == Wait::came) continue;
    give_ticket_back(bytes, ticket);
    tell_change(known.object);
    return ended;
  }
}

void release_shared(Condition& known, ConditionBytes& bytes, bool all) {
  if (bytes.released == bytes.next_ticket) return;
  bytes.released = all ? bytes.next_ticket : bytes.released + 1;
  ++bytes.changes;
  tell_change(known.object);
}

// True if calls are on their way out of their wait: signalled, and not continued yet.
bool is_anybody_leaving(const ConditionBytes& bytes) {
  if (bytes.is_shared()) return bytes.inside > bytes.next_ticket - bytes.released;
  if (bytes.known == nullptr || bytes.known->inside == 0) return false;
  std::uint32_t waiting = 0;
  for (const kernel::Task* task = bytes.known->object.first_waiter; task != nullptr; task = task->next_waiter)
    ++waiting;
  return bytes.known->inside > waiting;
}
bool has_everybody_left(const void* bytes) { return !is_anybody_leaving(*static_cast<const ConditionBytes*>(bytes)); }

// Scope of a wait: who destroys the condition meanwhile waits until it ends, as its bytes may be gone then.
class Inside {
 public:
  Inside(Condition& known, ConditionBytes& bytes)
      : known_(known), count_(bytes.is_shared() ? bytes.inside : known.inside) {
    ++count_;
  }
  ~Inside() {
    --count_;
    tell_change(known_.last_leaves);
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

 private:
  Condition& known_;
  std::uint32_t& count_;
};

// A waiter's mutex, which it takes again however the wait ends: when a handler ends the thread, too, before the
// thread's cleanup handlers run.
class GivenUp {
 public:
  explicit GivenUp(pthread_mutex_t& mutex) : mutex_(mutex), depth_(release(mutex)) {}
  ~GivenUp() {
    if (!is_taken_) take_again();
  }
  GivenUp(const GivenUp&) = delete;
  GivenUp& operator=(const GivenUp&) = delete;

  /// Returns an error number.
  int take_again() {
    is_taken_ = true;
    pass(kernel::Operation::lock, &mutex_of(&mutex_).object);
    const int error = lock(mutex_, Time::max());
    if (is_mine(mutex_)) set_depth(mutex_, depth_);
    return error;
  }

 private:
  pthread_mutex_t& mutex_;
  std::uint32_t depth_;
  bool is_taken_ = false;
};

int wait_before(pthread_cond_t* condition, pthread_mutex_t* bytes, Time deadline) {
  if (!is_simulated()) refuse("a thread waits before main() begins");
  ConditionBytes& words = bytes_of(condition);
  words.check("waits for");
  Condition& known = bytes_of(condition).waitable();
  if (is_destroyed(*bytes)) return EINVAL;
  Mutex& mutex = mutex_of(bytes);
  const CancellationPoint point;
  pass(kernel::Operation::wait, &known.object);
  if (!is_mine(*bytes) && type_of(*bytes) != PTHREAD_MUTEX_TIMED_NP) return EPERM;
  if (!is_mine(*bytes)) note_misuse("waits for a condition with", mutex, ", which it has not locked");
  // Who was signalled waits no longer, though it has not continued yet.
  if (!words.is_shared() && known.object.first_waiter != nullptr && known.mutex != &mutex)
    note_misuse("waits for", known, " with another mutex than those that wait already");
  known.mutex = &mutex;
  // Unlock and wait are one step, without a waitpoint between, so the happens-before edge is reported here.
  if (kernel::sanitizer::present) kernel::sanitizer::release(&mutex.object);
  const std::uint64_t ticket = words.is_shared() ? take_ticket(words) : 0;
  GivenUp given_up(*bytes);
  // After a signal handler the wait is not resumed, as a pthread_cond_signal() meanwhile would miss this thread: the
  // call returns as if signalled.
  Wait ended = Wait::came;
  {
    const Inside inside(known, words);
    if (words.is_shared())
      ended = wait_shared(known, words, ticket, deadline, point);
    else if (!kernel::chooser(*kernel::running->scheduler).is_spurious(*kernel::running))
      ended = deadline > kernel::running->local_time ? point.block(known.object, deadline) : Wait::timed_out;
  }
  if (ended == Wait::interrupted && !point.was_cancelled()) handle_signals();
  const int error = given_up.take_again();
  // A signal that came is not lost on a cancelled thread: it continues, and exits at its next cancellation point.
  if (ended != Wait::came && point.was_cancelled()) leave_if_cancelled();
  return error != 0 ? error : ended == Wait::timed_out ? ETIMEDOUT : 0;
}

int notify(pthread_cond_t* condition, bool all) {
  if (!is_simulated()) return 0;
  bytes_of(condition).check("signals");
  Condition& known = bytes_of(condition).waitable();
  pass(all ? kernel::Operation::notify_all : kernel::Operation::notify_one, &known.object);
  if (bytes_of(condition).is_shared())
    release_shared(known, bytes_of(condition), all);
  else if (all)
    kernel::wake_all(*kernel::running->scheduler, known.object);
  else
    wake_one(known.object);
  return 0;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_cond_init(pthread_cond_t* condition, const pthread_condattr_t* attributes) noexcept {
  std::memset(condition, 0, sizeof *condition);
  if (attributes == nullptr) return 0;
  int sharing = PTHREAD_PROCESS_PRIVATE;
  pthread_condattr_getclock(attributes, &bytes_of(condition).clock);
  pthread_condattr_getpshared(attributes, &sharing);
  if (sharing == PTHREAD_PROCESS_SHARED) bytes_of(condition).mark = mark_of_shared;
  return 0;
}

WAITPOINT_INTERPOSED int pthread_cond_destroy(pthread_cond_t* condition) noexcept {
  ConditionBytes& bytes = bytes_of(condition);
  while (is_simulated() && is_anybody_leaving(bytes)) {
    kernel::Object& end = bytes.waitable().last_leaves;
    kernel::enter(end);
    if (wait_on_shared(end, Time::max(), has_everybody_left, &bytes) == Wait::interrupted) handle_signals();
  }
  bytes.destroy(Waitable::Kind::condition);
  return 0;
}

WAITPOINT_INTERPOSED int pthread_cond_signal(pthread_cond_t* condition) noexcept { return notify(condition, false); }
WAITPOINT_INTERPOSED int pthread_cond_broadcast(pthread_cond_t* condition) noexcept { return notify(condition, true); }

WAITPOINT_INTERPOSED int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  return wait_before(condition, mutex, Time::max());
}

WAITPOINT_INTERPOSED int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                                                const timespec* deadline) {
  if (!is_valid(*deadline) || !is_clock_of_deadlines(clock)) return EINVAL;
  return wait_before(condition, mutex, when(clock, *deadline));
}

WAITPOINT_INTERPOSED int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                                                const timespec* deadline) {
  return pthread_cond_clockwait(condition, mutex, bytes_of(condition).clock, deadline);
}
