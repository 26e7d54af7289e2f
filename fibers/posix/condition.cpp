// SPDX-License-Identifier: BSD-3-Clause
//
// pthread_cond_t: in its own bytes a word that leads to what is known of it, and the clock of its deadlines.
#include <pthread.h>

#include <cerrno>
#include <cstring>

#include "fibers/kernel/sanitizer.hpp"
#include "fibers/posix/cancellation.hpp"
#include "fibers/posix/clocks.hpp"
#include "fibers/posix/interposed.hpp"
#include "fibers/posix/mutex.hpp"
#include "fibers/posix/program.hpp"
#include "fibers/posix/signals.hpp"

namespace waitpoint::posix {
namespace {

struct Condition : Waitable {
  static constexpr Kind kind_of_all = Kind::condition;
  explicit Condition(const void* address) : Waitable(kind_of_all, "condition variable", address) {}
};

struct Bytes {
  Condition* known;
  clockid_t clock;  // 0: CLOCK_REALTIME
};
static_assert(sizeof(Bytes) <= sizeof(pthread_cond_t));

Bytes& bytes_of(pthread_cond_t* condition) { return *reinterpret_cast<Bytes*>(condition); }

int wait_before(pthread_cond_t* condition, pthread_mutex_t* bytes, Time deadline) {
  if (!is_simulated()) refuse("a thread waits before main() begins");
  Condition& known = waitable_at(bytes_of(condition).known, condition);
  Mutex& mutex = mutex_of(bytes);
  const CancellationPoint point;
  pass(kernel::Operation::wait, &known.object);
  if (mutex.object.owner != kernel::running && type_of(*bytes) != PTHREAD_MUTEX_TIMED_NP) return EPERM;
  // Unlocked and waiting in one step, without a waitpoint between: nothing else tells what happened before it.
  if (kernel::sanitizer::present) kernel::sanitizer::release(&mutex.object);
  const std::uint32_t depth = release(mutex);
  // A handler is no reason to wait on: who signals meanwhile does not find it waiting. It comes back as if signalled.
  Wait ended = Wait::came;
  if (!kernel::running->scheduler->chooser().is_spurious(*kernel::running))
    ended = deadline > kernel::running->local_time ? point.block(known.object, deadline) : Wait::timed_out;
  if (ended == Wait::interrupted && !point.was_cancelled()) handle_signals();
  pass(kernel::Operation::lock, &mutex.object);
  const int error = lock(mutex, type_of(*bytes), Time::max());
  mutex.depth = depth;
  if (point.was_cancelled()) leave_if_cancelled();
  return error != 0 ? error : ended == Wait::timed_out ? ETIMEDOUT : 0;
}

int notify(pthread_cond_t* condition, bool all) {
  if (!is_simulated()) return 0;
  Condition& known = waitable_at(bytes_of(condition).known, condition);
  pass(all ? kernel::Operation::notify_all : kernel::Operation::notify_one, &known.object);
  if (all)
    kernel::running->scheduler->wake_all(known.object);
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
  if (attributes != nullptr) pthread_condattr_getclock(attributes, &bytes_of(condition).clock);
  return 0;
}

WAITPOINT_INTERPOSED int pthread_cond_destroy(pthread_cond_t* condition) noexcept {
  Bytes& bytes = bytes_of(condition);
  if (bytes.known != nullptr) forget(*bytes.known);
  bytes.known = nullptr;
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
