// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/mutex.hpp"

#include <cerrno>
#include <cstring>

#include "fibers/kernel/sanitizer.hpp"
#include "fibers/posix/clocks.hpp"
#include "fibers/posix/interposed.hpp"
#include "fibers/posix/robust_mutexes.hpp"
#include "fibers/posix/signals.hpp"

namespace waitpoint::posix {
namespace {

void hand_on(Mutex& mutex) {
  kernel::disown(mutex.object);
  mutex.depth = 0;
  if (kernel::Task* next = wake_one(mutex.object); next != nullptr) {
    kernel::own(mutex.object, *next);
    mutex.depth = 1;
  }
}

// What the new owner is told.
int enter(Mutex& mutex) {
  if (!mutex.owner_died) return 0;
  mutex.owner_died = false;
  mutex.is_inconsistent = true;
  return EOWNERDEAD;
}

// What locking again comes to for the owner, unless it waits for itself: -1.
int lock_again(Mutex& mutex, int type) {
  if (type == PTHREAD_MUTEX_ERRORCHECK_NP) return EDEADLK;
  if (type != PTHREAD_MUTEX_RECURSIVE_NP) return -1;
  if (mutex.depth == UINT32_MAX) return EAGAIN;
  ++mutex.depth;
  return 0;
}

int lock_before(pthread_mutex_t* bytes, Time deadline, bool is_valid_deadline) {
  Mutex& mutex = mutex_of(bytes);
  pass(kernel::Operation::lock, &mutex.object);
  // What the owner locks again looks at no deadline, unless it is to wait for itself.
  const bool is_known = mutex.object.owner == kernel::running && type_of(*bytes) != PTHREAD_MUTEX_TIMED_NP &&
                        type_of(*bytes) != PTHREAD_MUTEX_ADAPTIVE_NP;
  if (!is_valid_deadline && mutex.object.owner != nullptr && !is_known) return EINVAL;
  return lock(mutex, type_of(*bytes), deadline);
}

int try_lock(pthread_mutex_t* bytes) {
  Mutex& mutex = mutex_of(bytes);
  pass(kernel::Operation::try_lock, &mutex.object);
  if (mutex.is_lost) return ENOTRECOVERABLE;
  if (mutex.object.owner == kernel::running && type_of(*bytes) == PTHREAD_MUTEX_RECURSIVE_NP)
    return lock_again(mutex, PTHREAD_MUTEX_RECURSIVE_NP);
  if (mutex.object.owner != nullptr) return EBUSY;
  return lock(mutex, type_of(*bytes), Time::max());
}

int unlock(pthread_mutex_t* bytes) {
  Mutex& mutex = mutex_of(bytes);
  pass(kernel::Operation::unlock, &mutex.object);
  const bool is_mine = mutex.object.owner == kernel::running;
  if (!is_mine && (type_of(*bytes) == PTHREAD_MUTEX_ERRORCHECK_NP || type_of(*bytes) == PTHREAD_MUTEX_RECURSIVE_NP ||
                   mutex.is_robust))
    return EPERM;
  // Of the plain kind: glibc lets any thread unlock it, locked or not.
  if (mutex.object.owner == nullptr) return 0;
  if (mutex.depth > 1) {
    --mutex.depth;
    return 0;
  }
  if (mutex.is_inconsistent) {
    mutex.is_inconsistent = false;
    mutex.is_lost = true;
    kernel::disown(mutex.object);
    kernel::running->scheduler->wake_all(mutex.object);
    return 0;
  }
  hand_on(mutex);
  return 0;
}

}  // namespace

int lock(Mutex& mutex, int type, Time deadline) {
  if (mutex.is_lost) return ENOTRECOVERABLE;
  if (mutex.object.owner == kernel::running)
    if (const int result = lock_again(mutex, type); result >= 0) return result;
  while (mutex.object.owner != nullptr) {
    if (deadline <= kernel::running->local_time) return ETIMEDOUT;
    const Wait ended = wait_on(mutex.object, deadline);
    if (ended == Wait::timed_out) return ETIMEDOUT;
    if (ended == Wait::interrupted) handle_signals();
    if (mutex.is_lost) return ENOTRECOVERABLE;
    if (ended == Wait::came) return enter(mutex);
  }
  kernel::own(mutex.object, *kernel::running);
  mutex.depth = 1;
  return enter(mutex);
}

std::uint32_t release(Mutex& mutex) {
  const std::uint32_t depth = mutex.depth;
  if (mutex.object.owner != nullptr) hand_on(mutex);
  return depth;
}

void let_robust_mutexes_go() {
  kernel::Object* held = kernel::running->held;
  while (held != nullptr) {
    kernel::Object* const next = held->next_held;
    if (const Waitable* waitable = waitable_of(*held); waitable != nullptr && waitable->kind == Waitable::Kind::mutex) {
      auto& mutex = *static_cast<Mutex*>(const_cast<Waitable*>(waitable));
      if (mutex.is_robust) {
        mutex.owner_died = true;
        mutex.is_inconsistent = false;
        if (kernel::sanitizer::present) kernel::sanitizer::release(&mutex.object);  // without a waitpoint
        hand_on(mutex);
      }
    }
    held = next;
  }
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_mutex_init(pthread_mutex_t* mutex, const pthread_mutexattr_t* attributes) noexcept {
  const int error = WAITPOINT_NEXT(pthread_mutex_init)(mutex, attributes);
  if (error == 0) mutex->__data.__list.__prev = nullptr;
  return error;
}

WAITPOINT_INTERPOSED int pthread_mutex_destroy(pthread_mutex_t* mutex) noexcept {
  auto*& known = reinterpret_cast<Mutex*&>(mutex->__data.__list.__prev);
  if (known == nullptr) return 0;
  if (!known->idle()) return EBUSY;
  forget(*known);
  known = nullptr;
  return 0;
}

// Before main() there is one thread: no lock is in its way.
WAITPOINT_INTERPOSED int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  return is_simulated() ? lock_before(mutex, Time::max(), true) : 0;
}

WAITPOINT_INTERPOSED int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept {
  return is_simulated() ? try_lock(mutex) : 0;
}

WAITPOINT_INTERPOSED int pthread_mutex_unlock(pthread_mutex_t* mutex) noexcept {
  return is_simulated() ? unlock(mutex) : 0;
}

WAITPOINT_INTERPOSED int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock,
                                                 const timespec* deadline) noexcept {
  if (!is_clock_of_deadlines(clock)) return EINVAL;
  if (!is_simulated()) return 0;
  return lock_before(mutex, when(clock, *deadline), is_valid(*deadline));
}

WAITPOINT_INTERPOSED int pthread_mutex_timedlock(pthread_mutex_t* mutex, const timespec* deadline) noexcept {
  return pthread_mutex_clocklock(mutex, CLOCK_REALTIME, deadline);
}

// The ceiling is kept where glibc keeps it, which its pthread_mutex_getprioceiling() reads; it changes nothing.
WAITPOINT_INTERPOSED int pthread_mutex_setprioceiling(pthread_mutex_t* mutex, int ceiling, int* old) noexcept {
  int before = 0;
  if (const int error = pthread_mutex_getprioceiling(mutex, &before); error != 0) return error;
  if (ceiling < sched_get_priority_min(SCHED_FIFO) || ceiling > sched_get_priority_max(SCHED_FIFO)) return EINVAL;
  if (const int error = pthread_mutex_lock(mutex); error != 0) return error;
  constexpr int shift_of_ceiling = 19;
  mutex->__data.__lock = ceiling << shift_of_ceiling;
  pthread_mutex_unlock(mutex);
  *old = before;
  return 0;
}

WAITPOINT_INTERPOSED int pthread_mutex_consistent(pthread_mutex_t* mutex) noexcept {
  Mutex& known = mutex_of(mutex);
  if (!known.is_robust || !known.is_inconsistent || known.object.owner != kernel::running) return EINVAL;
  known.is_inconsistent = false;
  return 0;
}
