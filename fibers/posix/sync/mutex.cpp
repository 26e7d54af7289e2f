// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/sync/mutex.hpp"

#include <cerrno>
#include <cstring>
#include <optional>

#include "core/error.hpp"
#include "fibers/kernel/ownership.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/lasting_waits.hpp"
#include "fibers/posix/family/misuse.hpp"
#include "fibers/posix/program/allocator.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/sync/robust_mutexes.hpp"
#include "fibers/posix/sync/shared_mutex.hpp"
#include "fibers/posix/time/clocks.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::posix {
namespace {

// The owner of what ended threads have left locked, without a list: a run may end, and its objects with it.
constinit kernel::Task ended_owner{.event = {},
                                   .local_time = {},
                                   .state = kernel::TaskState::ended,
                                   .fiber = {},
                                   .search = {},
                                   .name = "a thread that has ended"};

// Programs and debuggers read the owner where glibc has it.
void show_owner(pthread_mutex_t& bytes, const kernel::Task& owner) { bytes.__data.__owner = thread_of(owner).id; }
void show_no_owner(pthread_mutex_t& bytes) { bytes.__data.__owner = 0; }

pthread_mutex_t& bytes_of(const Mutex& mutex) {
  return *static_cast<pthread_mutex_t*>(const_cast<void*>(mutex.address));
}

void hand_on(Mutex& mutex) {
  take_from_owner(mutex.object);
  mutex.depth = 0;
  show_no_owner(bytes_of(mutex));
  if (kernel::Task* next = wake_one(mutex.object); next != nullptr) {
    kernel::own(mutex.object, *next);
    mutex.depth = 1;
    show_owner(bytes_of(mutex), *next);
  }
}

// Its owner unlocks it; if it is still inconsistent, it becomes unrecoverable.
void give_up(Mutex& mutex) {
  WAITPOINT_CHECK(mutex.object.owner != nullptr, "a mutex without an owner is given up");
  if (mutex.robust_state != Mutex::RobustState::inconsistent) return hand_on(mutex);
  mutex.robust_state = Mutex::RobustState::unrecoverable;
  take_from_owner(mutex.object);
  show_no_owner(bytes_of(mutex));
  kernel::wake_all(*kernel::running->scheduler, mutex.object);
}

// The result of the new owner's lock.
int enter(Mutex& mutex) {
  if (mutex.robust_state != Mutex::RobustState::owner_died) return 0;
  WAITPOINT_CHECK(mutex.is_robust, "a mutex that is not robust is marked as left by a dead owner");
  mutex.robust_state = Mutex::RobustState::inconsistent;
  return EOWNERDEAD;
}

// The result of a second lock by the owner; -1 if it would wait for itself.
int lock_again(Mutex& mutex, int type) {
  if (type == PTHREAD_MUTEX_ERRORCHECK_NP) return EDEADLK;
  if (type != PTHREAD_MUTEX_RECURSIVE_NP) return -1;
  if (mutex.depth == UINT32_MAX) return EAGAIN;
  ++mutex.depth;
  return 0;
}

Wait wait_for_owner(Mutex& mutex, Time deadline) {
  std::optional<NotedWait> noted;
  if (deadline == Time::max()) noted.emplace(*mutex.object.owner);
  return wait_on(mutex.object, deadline);
}

int wait_and_lock(Mutex& mutex, int type, Time deadline) {
  if (mutex.robust_state == Mutex::RobustState::unrecoverable) return ENOTRECOVERABLE;
  if (mutex.object.owner == kernel::running)
    if (const int result = lock_again(mutex, type); result >= 0) return result;
  while (mutex.object.owner != nullptr) {
    if (deadline <= kernel::running->local_time) return ETIMEDOUT;
    const Wait ended = wait_for_owner(mutex, deadline);
    if (ended == Wait::timed_out) return ETIMEDOUT;
    if (ended == Wait::interrupted) handle_signals();
    if (mutex.robust_state == Mutex::RobustState::unrecoverable) return ENOTRECOVERABLE;
    if (ended != Wait::came) continue;
    // Of the other types, any thread may have unlocked it again.
    WAITPOINT_CHECK((type != PTHREAD_MUTEX_ERRORCHECK_NP && type != PTHREAD_MUTEX_RECURSIVE_NP) ||
                        mutex.object.owner == kernel::running,
                    "a thread was woken for a mutex that was not handed over to it");
    return enter(mutex);
  }
  kernel::own(mutex.object, *kernel::running);
  mutex.depth = 1;
  show_owner(bytes_of(mutex), *kernel::running);
  return enter(mutex);
}

// The mutex, if it is there: null, with a report, if it was destroyed.
Mutex* mutex_for(const char* does, pthread_mutex_t* bytes) {
  if (is_destroyed(*bytes)) {
    note_misuse(does, Mutex(bytes), ", which was destroyed");
    return nullptr;
  }
  Mutex& mutex = mutex_of(bytes);
  check_is_there(does, mutex);
  return &mutex;
}

// The mutex after the waitpoint of a use: null, with a report, if it was destroyed before that, or meanwhile.
Mutex* reach(const char* does, kernel::Operation operation, pthread_mutex_t* bytes) {
  Mutex* const mutex = mutex_for(does, bytes);
  if (mutex == nullptr) return nullptr;
  pass(operation, &mutex->object);
  return !is_destroyed(*bytes) && mutex == &mutex_of(bytes) ? mutex : reach(does, operation, bytes);
}

// Short cuts for an uncontended lock and unlock, where no event can come between: the most frequent calls of programs.
[[gnu::always_inline]] inline bool lock_at_once(pthread_mutex_t& bytes) {
  Mutex* const mutex = reinterpret_cast<Mutex*>(bytes.__data.__list.__prev);
  kernel::Task* const task = kernel::running;
  if (mutex == nullptr || mutex->address != &bytes || mutex->object.owner != nullptr ||
      mutex->robust_state != Mutex::RobustState::consistent || mutex->is_freed)
    return false;
  if (!pass_at_once(task, kernel::Operation::lock, mutex->object)) return false;
  WAITPOINT_FAST_CHECK(mutex->object.owner == nullptr, "a mutex was taken during a short cut of its lock");
  kernel::own(mutex->object, *task);
  mutex->depth = 1;
  show_owner(bytes, *task);
  return true;
}

[[gnu::always_inline]] inline bool unlock_at_once(pthread_mutex_t& bytes) {
  Mutex* const mutex = reinterpret_cast<Mutex*>(bytes.__data.__list.__prev);
  kernel::Task* const task = kernel::running;
  if (mutex == nullptr || mutex->address != &bytes || mutex->object.first_waiter != nullptr || mutex->depth != 1 ||
      mutex->robust_state != Mutex::RobustState::consistent || mutex->object.owner != task)
    return false;
  if (!pass_at_once(task, kernel::Operation::unlock, mutex->object)) return false;
  WAITPOINT_FAST_CHECK(mutex->object.owner == task && mutex->object.first_waiter == nullptr,
                       "a mutex changed during a short cut of its unlock");
  kernel::disown(mutex->object, *task);
  show_no_owner(bytes);
  return true;
}

[[gnu::noinline]] int lock_before(pthread_mutex_t* bytes, Time deadline, bool is_valid_deadline) {
  Mutex* const there = reach("locks", kernel::Operation::lock, bytes);
  if (there == nullptr) return EINVAL;
  Mutex& mutex = *there;
  if (mutex.is_shared) return shared_mutex::lock(*bytes, deadline, is_valid_deadline);
  // A second lock by the owner ignores the deadline, unless it would wait for itself.
  const bool is_known = mutex.object.owner == kernel::running && type_of(*bytes) != PTHREAD_MUTEX_TIMED_NP &&
                        type_of(*bytes) != PTHREAD_MUTEX_ADAPTIVE_NP;
  if (!is_valid_deadline && mutex.object.owner != nullptr && !is_known) return EINVAL;
  return wait_and_lock(mutex, type_of(*bytes), deadline);
}

int try_lock(pthread_mutex_t* bytes) {
  Mutex* const there = reach("tries to lock", kernel::Operation::try_lock, bytes);
  if (there == nullptr) return EINVAL;
  Mutex& mutex = *there;
  if (mutex.is_shared) return shared_mutex::try_lock(*bytes);
  if (mutex.robust_state == Mutex::RobustState::unrecoverable) return ENOTRECOVERABLE;
  if (mutex.object.owner == kernel::running && type_of(*bytes) == PTHREAD_MUTEX_RECURSIVE_NP)
    return lock_again(mutex, PTHREAD_MUTEX_RECURSIVE_NP);
  // As glibc, which leaves these to the system.
  const bool is_told = mutex.is_robust || inherits_priority(*bytes);
  if (mutex.object.owner == kernel::running && type_of(*bytes) == PTHREAD_MUTEX_ERRORCHECK_NP && is_told)
    return EDEADLK;
  if (mutex.object.owner != nullptr) return EBUSY;
  return wait_and_lock(mutex, type_of(*bytes), Time::max());
}

[[gnu::noinline]] int unlock(pthread_mutex_t* bytes) {
  const bool is_new = bytes->__data.__list.__prev == nullptr;  // it may have been locked before main()
  Mutex* const there = reach("unlocks", kernel::Operation::unlock, bytes);
  if (there == nullptr) return EINVAL;
  Mutex& mutex = *there;
  if (mutex.is_shared) return shared_mutex::unlock(*bytes);
  const bool is_mine = mutex.object.owner == kernel::running;
  if (!is_mine && (type_of(*bytes) == PTHREAD_MUTEX_ERRORCHECK_NP || type_of(*bytes) == PTHREAD_MUTEX_RECURSIVE_NP ||
                   mutex.is_robust || inherits_priority(*bytes)))
    return EPERM;
  // A normal mutex: glibc lets any thread unlock it, locked or not.
  if (mutex.object.owner == nullptr) {
    if (!is_new) note_misuse("unlocks", mutex, ", which is not locked");
    return 0;
  }
  if (!is_mine) note_misuse("unlocks", mutex, ", locked by ", mutex.object.owner);
  if (mutex.depth > 1) {
    --mutex.depth;
    return 0;
  }
  give_up(mutex);
  return 0;
}

}  // namespace

int lock(pthread_mutex_t& bytes, Time deadline) {
  if (is_shared(bytes)) return shared_mutex::lock(bytes, deadline, true);
  return wait_and_lock(mutex_of(&bytes), type_of(bytes), deadline);
}

std::uint32_t release(pthread_mutex_t& bytes) {
  if (is_shared(bytes)) return shared_mutex::release(bytes);
  Mutex& mutex = mutex_of(&bytes);
  const std::uint32_t depth = mutex.depth;
  if (mutex.object.owner != nullptr) give_up(mutex);
  return depth;
}

void set_depth(pthread_mutex_t& bytes, std::uint32_t depth) {
  if (is_shared(bytes)) return shared_mutex::set_depth(bytes, depth);
  mutex_of(&bytes).depth = depth;
}

bool is_mine(pthread_mutex_t& bytes) {
  return is_shared(bytes) ? shared_mutex::is_mine(bytes) : mutex_of(&bytes).object.owner == kernel::running;
}

void leave_held_objects() {
  while (kernel::Object* const held = kernel::running->held) {
    kernel::disown(*held, *kernel::running);
    held->owner = &ended_owner;
  }
}

void leave_mutexes_of(kernel::Task& task) {
  for (kernel::Object *held = task.held, *next = nullptr; held != nullptr; held = next) {
    next = held->next_held;
    const Waitable* const waitable = waitable_of(*held);
    if (waitable == nullptr || waitable->kind != Waitable::Kind::mutex ||
        static_cast<const Mutex*>(waitable)->is_shared)
      continue;
    kernel::disown(*held, task);
    held->owner = &ended_owner;
  }
}

void take_from_owner(kernel::Object& object) {
  if (object.owner == &ended_owner)
    object.owner = nullptr;
  else
    kernel::disown(object);
}

void leave_shared_mutexes() {
  for (kernel::Object *held = kernel::running->held, *next = nullptr; held != nullptr; held = next) {
    WAITPOINT_CHECK(held->owner == kernel::running, "a thread's list of held objects has another's");
    next = held->next_held;
    const Waitable* const waitable = waitable_of(*held);
    if (waitable != nullptr && waitable->kind == Waitable::Kind::mutex &&
        static_cast<const Mutex*>(waitable)->is_shared)
      kernel::disown(*held);
  }
}

void let_robust_mutexes_go() {
  kernel::Object* held = kernel::running->held;
  while (held != nullptr) {
    WAITPOINT_CHECK(held->owner == kernel::running, "a thread's list of held objects has another's");
    kernel::Object* const next = held->next_held;
    if (const Waitable* waitable = waitable_of(*held); waitable != nullptr && waitable->kind == Waitable::Kind::mutex) {
      auto& mutex = *static_cast<Mutex*>(const_cast<Waitable*>(waitable));
      if (mutex.is_shared && mutex.is_robust) {
        shared_mutex::let_go(*static_cast<pthread_mutex_t*>(const_cast<void*>(mutex.address)));
      } else if (mutex.is_robust) {
        mutex.robust_state = Mutex::RobustState::owner_died;
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
  if (error != 0) return error;
  mutex->__data.__list.__prev = nullptr;
  // glibc marks all robust mutexes as shared.
  int sharing = PTHREAD_PROCESS_PRIVATE;
  if (attributes != nullptr) pthread_mutexattr_getpshared(attributes, &sharing);
  if (sharing == PTHREAD_PROCESS_PRIVATE) mutex->__data.__kind &= ~Mutex::shared_bit;
  return 0;
}

WAITPOINT_INTERPOSED int pthread_mutex_destroy(pthread_mutex_t* mutex) noexcept {
  auto*& known = reinterpret_cast<Mutex*&>(mutex->__data.__list.__prev);
  if (is_destroyed(*mutex)) return 0;
  if (is_shared(*mutex)) return shared_mutex::destroy(*mutex);
  if (known != nullptr && known->address != mutex) known = nullptr;  // a copy's is the original's
  if (known != nullptr && !known->idle()) {
    note_misuse("destroys", *known, ", locked by ", known->object.owner);
    return EBUSY;
  }
  if (known != nullptr) forget(*known);
  known = nullptr;
  mutex->__data.__kind = kind_of_destroyed;
  return 0;
}

// Before main() there is one thread: a lock is always free.
WAITPOINT_INTERPOSED int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  if (lock_at_once(*mutex)) return 0;
  if (is_allocator(__builtin_return_address(0))) return WAITPOINT_NEXT(pthread_mutex_lock)(mutex);
  return is_simulated() ? lock_before(mutex, Time::max(), true) : 0;
}

WAITPOINT_INTERPOSED int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept {
  if (is_allocator(__builtin_return_address(0))) return WAITPOINT_NEXT(pthread_mutex_trylock)(mutex);
  return is_simulated() ? try_lock(mutex) : 0;
}

WAITPOINT_INTERPOSED int pthread_mutex_unlock(pthread_mutex_t* mutex) noexcept {
  if (unlock_at_once(*mutex)) return 0;
  if (is_allocator(__builtin_return_address(0))) return WAITPOINT_NEXT(pthread_mutex_unlock)(mutex);
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

// The ceiling is stored where glibc's pthread_mutex_getprioceiling() reads it; it has no effect.
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
  if (known.is_shared) return known.is_robust ? shared_mutex::make_consistent(*mutex) : EINVAL;
  if (!known.is_robust || known.robust_state != Mutex::RobustState::inconsistent ||
      known.object.owner != kernel::running)
    return EINVAL;
  known.robust_state = Mutex::RobustState::consistent;
  return 0;
}
