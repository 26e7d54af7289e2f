// SPDX-License-Identifier: BSD-3-Clause
//
// pthread_rwlock_t: the program's object holds the preference, where glibc has it, and a pointer to the waitable.
#include <pthread.h>

#include <cerrno>
#include <cstddef>

#include "core/error.hpp"
#include "fibers/kernel/ownership.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/misuse.hpp"
#include "fibers/posix/program/waitable.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/sync/robust_mutexes.hpp"
#include "fibers/posix/sync/shared_rwlock.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

struct RwLock : Waitable {
  static constexpr Kind kind_of_all = Kind::rwlock;
  explicit RwLock(const void* address) : Waitable(kind_of_all, "read-write lock", address) {}

  bool free() const {
    WAITPOINT_FAST_CHECK(object.owner == nullptr || readers == 0, "a read-write lock has a writer and readers");
    return object.owner == nullptr && readers == 0;
  }
  kernel::Task* first_waiting_writer() const {
    kernel::Task* task = object.first_waiter;
    while (task != nullptr && task->shared_wait) task = task->next_waiter;
    return task;
  }

  std::uint32_t readers = 0;  ///< that hold it
};

static_assert(sizeof(void*) <= offsetof(pthread_rwlock_t, __data.__shared) &&
              alignof(RwLock*) <= alignof(pthread_rwlock_t));

// As in glibc, `__flags` is the kind. The other fields are unused.
RwLock& lock_of(pthread_rwlock_t* lock) {
  if (shared_rwlock::is_shared(*lock)) return waitable_at<RwLock>(lock);
  return waitable_at(*reinterpret_cast<RwLock**>(lock), lock);
}

// The mark of a destroyed one is in glibc's padding.
void check(const char* does, const pthread_rwlock_t& bytes) {
  if (shared_rwlock::is_shared(bytes)) return;
  const RwLock* const known = *reinterpret_cast<RwLock* const*>(&bytes);
  if (known == nullptr && bytes.__data.__pad4 == mark_of_destroyed)
    note_misuse(does, RwLock(&bytes), ", which was destroyed");
  else if (known != nullptr && known->address == &bytes)
    check_is_there(does, *known);
}

// The lock after the waitpoint of a use. One that was destroyed meanwhile is another one from then on, with a
// waitpoint.
RwLock& reach(const char* does, kernel::Operation operation, pthread_rwlock_t* bytes) {
  check(does, *bytes);
  RwLock& lock = lock_of(bytes);
  pass(operation, &lock.object);
  const bool is_there = shared_rwlock::is_shared(*bytes) || *reinterpret_cast<RwLock* const*>(bytes) == &lock;
  return is_there ? lock : reach(does, operation, bytes);
}

bool prefers_writers(const pthread_rwlock_t& bytes) {
  return bytes.__data.__flags == PTHREAD_RWLOCK_PREFER_WRITER_NONRECURSIVE_NP;
}

// As in glibc: readers overtake waiting writers, unless the lock prefers writers.
bool readers_wait(const pthread_rwlock_t& bytes, const RwLock& lock) {
  return prefers_writers(bytes) && lock.first_waiting_writer() != nullptr;
}

int read_before(pthread_rwlock_t* bytes, Time deadline, bool valid) {
  RwLock& lock = reach("locks", kernel::Operation::lock_shared, bytes);
  if (shared_rwlock::is_shared(*bytes)) return shared_rwlock::read_before(*bytes, lock.object, deadline, valid);
  if (lock.object.owner == kernel::running) return EDEADLK;
  for (;;) {
    if (lock.object.owner == nullptr && !readers_wait(*bytes, lock)) {
      if (lock.readers == UINT32_MAX) return EAGAIN;
      ++lock.readers;
      return 0;
    }
    if (!valid) return EINVAL;
    if (deadline <= kernel::running->local_time) return ETIMEDOUT;
    kernel::running->shared_wait = true;
    const Wait ended = wait_on(lock.object, deadline);
    kernel::running->shared_wait = false;
    if (ended != Wait::interrupted) return ended == Wait::came ? 0 : ETIMEDOUT;
    handle_signals();
  }
}

// All waiting readers get the lock.
void admit_readers(RwLock& lock) {
  WAITPOINT_CHECK(lock.object.owner == nullptr, "readers are admitted to a read-write lock that a writer holds");
  for (kernel::Task *task = lock.object.first_waiter, *next = nullptr; task != nullptr; task = next) {
    next = task->next_waiter;
    if (!task->shared_wait) continue;
    ++lock.readers;
    kernel::wake(*kernel::running->scheduler, *task);
  }
}

int write_before(pthread_rwlock_t* bytes, Time deadline, bool valid) {
  RwLock& lock = reach("locks", kernel::Operation::lock, bytes);
  if (shared_rwlock::is_shared(*bytes)) return shared_rwlock::write_before(*bytes, lock.object, deadline, valid);
  if (lock.object.owner == kernel::running) return EDEADLK;
  for (;;) {
    if (lock.free()) {
      kernel::own(lock.object, *kernel::running);
      return 0;
    }
    if (!valid) return EINVAL;
    if (deadline <= kernel::running->local_time) return ETIMEDOUT;
    WAITPOINT_CHECK(!kernel::running->shared_wait, "a thread that waits to write counts as a reader");
    const Wait ended = wait_on(lock.object, deadline);
    if (ended == Wait::came) return 0;
    // This writer may have been the only one that made readers wait.
    if (lock.object.owner == nullptr && !readers_wait(*bytes, lock)) admit_readers(lock);
    if (ended == Wait::timed_out) return ETIMEDOUT;
    handle_signals();
  }
}

// The free lock goes to the chosen waiter; if that is a reader, to all waiting readers.
void hand_on(RwLock& lock, bool prefers_writers) {
  WAITPOINT_CHECK(lock.free(), "a read-write lock is handed over that is held");
  kernel::Task* first = prefers_writers ? lock.first_waiting_writer() : nullptr;
  if (first != nullptr)
    kernel::wake(*kernel::running->scheduler, *first);
  else
    first = wake_one(lock.object);
  if (first == nullptr) return;
  if (!first->shared_wait) return kernel::own(lock.object, *first);
  ++lock.readers;
  admit_readers(lock);
}

int unlock(pthread_rwlock_t* bytes) {
  const bool is_new = *reinterpret_cast<RwLock* const*>(bytes) == nullptr;  // it may have been locked before main()
  RwLock& lock = reach("unlocks", kernel::Operation::unlock, bytes);
  if (shared_rwlock::is_shared(*bytes)) return shared_rwlock::unlock(*bytes, lock.object);
  if (lock.free() && !is_new) note_misuse("unlocks", lock, ", which is not locked");
  if (lock.object.owner != nullptr && lock.object.owner != kernel::running)
    note_misuse("unlocks", lock, ", locked by ", lock.object.owner);
  if (lock.object.owner != nullptr)
    take_from_owner(lock.object);
  else if (lock.readers > 0)
    --lock.readers;
  if (lock.free()) hand_on(lock, prefers_writers(*bytes));
  return 0;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_rwlock_init(pthread_rwlock_t* lock, const pthread_rwlockattr_t* attributes) noexcept {
  const int error = WAITPOINT_NEXT(pthread_rwlock_init)(lock, attributes);
  if (error != 0) return error;
  *reinterpret_cast<RwLock**>(lock) = nullptr;
  lock->__data.__pad4 = 0;
  return 0;
}

WAITPOINT_INTERPOSED int pthread_rwlock_destroy(pthread_rwlock_t* lock) noexcept {
  RwLock*& known = *reinterpret_cast<RwLock**>(lock);
  if (known != nullptr && known->address != lock) known = nullptr;  // a copy's is the original's
  Waitable* const waitable =
      shared_rwlock::is_shared(*lock) ? find_waitable(lock, Waitable::Kind::rwlock) : static_cast<Waitable*>(known);
  if (waitable != nullptr && !shared_rwlock::is_shared(*lock)) {
    const kernel::Task* const owner = waitable->object.owner;
    if (owner != nullptr) note_misuse("destroys", *waitable, ", locked by ", owner);
    if (owner == nullptr && known->readers > 0) note_misuse("destroys", *waitable, ", locked by readers");
  }
  if (waitable != nullptr) forget(*waitable);
  known = nullptr;
  if (!shared_rwlock::is_shared(*lock)) lock->__data.__pad4 = mark_of_destroyed;
  return 0;
}

// Before main() there is one thread: a lock is always free.
WAITPOINT_INTERPOSED int pthread_rwlock_rdlock(pthread_rwlock_t* lock) noexcept {
  return is_simulated() ? read_before(lock, Time::max(), true) : 0;
}
WAITPOINT_INTERPOSED int pthread_rwlock_wrlock(pthread_rwlock_t* lock) noexcept {
  return is_simulated() ? write_before(lock, Time::max(), true) : 0;
}
WAITPOINT_INTERPOSED int pthread_rwlock_unlock(pthread_rwlock_t* lock) noexcept {
  return is_simulated() ? unlock(lock) : 0;
}

WAITPOINT_INTERPOSED int pthread_rwlock_tryrdlock(pthread_rwlock_t* lock) noexcept {
  const int error = is_simulated() ? read_before(lock, Time(), true) : 0;
  return error == ETIMEDOUT || error == EDEADLK ? EBUSY : error;
}
WAITPOINT_INTERPOSED int pthread_rwlock_trywrlock(pthread_rwlock_t* lock) noexcept {
  const int error = is_simulated() ? write_before(lock, Time(), true) : 0;
  return error == ETIMEDOUT || error == EDEADLK ? EBUSY : error;
}

WAITPOINT_INTERPOSED int pthread_rwlock_clockrdlock(pthread_rwlock_t* lock, clockid_t clock,
                                                    const timespec* deadline) noexcept {
  if (!is_clock_of_deadlines(clock)) return EINVAL;
  return is_simulated() ? read_before(lock, when(clock, *deadline), is_valid(*deadline)) : 0;
}
WAITPOINT_INTERPOSED int pthread_rwlock_clockwrlock(pthread_rwlock_t* lock, clockid_t clock,
                                                    const timespec* deadline) noexcept {
  if (!is_clock_of_deadlines(clock)) return EINVAL;
  return is_simulated() ? write_before(lock, when(clock, *deadline), is_valid(*deadline)) : 0;
}
WAITPOINT_INTERPOSED int pthread_rwlock_timedrdlock(pthread_rwlock_t* lock, const timespec* deadline) noexcept {
  return pthread_rwlock_clockrdlock(lock, CLOCK_REALTIME, deadline);
}
WAITPOINT_INTERPOSED int pthread_rwlock_timedwrlock(pthread_rwlock_t* lock, const timespec* deadline) noexcept {
  return pthread_rwlock_clockwrlock(lock, CLOCK_REALTIME, deadline);
}
