// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/sync/shared_mutex.hpp"

#include <cerrno>
#include <cstddef>

#include "fibers/kernel/ownership.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/sync/robust_mutexes.hpp"
#include "fibers/posix/sync/shared_object.hpp"

namespace waitpoint::posix::shared_mutex {
namespace {

// Laid over glibc's fields: the ceiling, the kind and the pointer to a private mutex's waitable keep their places.
struct Bytes {
  int ceiling;
  std::uint32_t depth;
  int thread;  // gettid() of the owner
  pid_t process;
  int kind;
  std::uint32_t changes;
  void* unused;
  Mutex::RobustState robust_state;
};
static_assert(offsetof(Bytes, kind) == offsetof(pthread_mutex_t, __data.__kind));
static_assert(offsetof(Bytes, unused) == offsetof(pthread_mutex_t, __data.__list.__prev));
static_assert(offsetof(Bytes, ceiling) == offsetof(pthread_mutex_t, __data.__lock));
static_assert(sizeof(Bytes) <= sizeof(pthread_mutex_t));

Bytes& words_of(pthread_mutex_t& bytes) { return reinterpret_cast<Bytes&>(bytes); }

bool is_mine(const Bytes& words) { return words.process == family::this_process() && words.thread == this_thread().id; }

int lock_again(Bytes& words, int type) {
  if (type == PTHREAD_MUTEX_ERRORCHECK_NP) return EDEADLK;
  if (type != PTHREAD_MUTEX_RECURSIVE_NP) return -1;
  if (words.depth == UINT32_MAX) return EAGAIN;
  ++words.depth;
  return 0;
}

// 0, an error, or -1 if it is held. A robust one is free if its owner's process has ended.
int try_to_take(Bytes& words, Mutex& mutex) {
  if (words.robust_state == Mutex::RobustState::unrecoverable) return ENOTRECOVERABLE;
  if (words.process != 0 && mutex.is_robust && words.process != family::this_process() &&
      !family::lives(words.process)) {
    words.process = 0;
    words.robust_state = Mutex::RobustState::owner_died;
  }
  if (words.process != 0) return -1;
  words.process = family::this_process();
  words.thread = this_thread().id;
  words.depth = 1;
  if (words.robust_state != Mutex::RobustState::owner_died) return 0;
  words.robust_state = Mutex::RobustState::inconsistent;
  return EOWNERDEAD;
}

// Until it is given up; a robust one also until its owner's process has ended.
Wait wait_for_owner(const Bytes& words, Mutex& mutex, std::uint32_t seen, Time deadline) {
  if (!mutex.is_robust) return wait_for_change(mutex.object, words.changes, seen, deadline);
  struct Owned {
    const Bytes* words;
    std::uint32_t seen;
  } const owned{&words, seen};
  const auto is_given_up = [](const void* what) {
    const auto& [bytes, changes] = *static_cast<const Owned*>(what);
    return bytes->changes != changes || (bytes->process != 0 && !family::lives(bytes->process));
  };
  return wait_on_shared(mutex.object, deadline, is_given_up, &owned);
}

void note_owner(Mutex& mutex) {
  if (mutex.object.owner == nullptr) kernel::own(mutex.object, *kernel::running);
}

int take_or_tell(Bytes& words, Mutex& mutex, std::uint32_t& changes) {
  changes = words.changes;
  return try_to_take(words, mutex);
}

// The state after an unlock: a mutex that is still inconsistent becomes unrecoverable.
Mutex::RobustState state_after(const Bytes& words) {
  return words.robust_state == Mutex::RobustState::inconsistent ? Mutex::RobustState::unrecoverable
                                                                : words.robust_state;
}

void give_up(Bytes& words, Mutex& mutex, Mutex::RobustState robust_state) {
  words.process = words.thread = 0;
  words.depth = 0;
  words.robust_state = robust_state;
  ++words.changes;
  if (mutex.object.owner != nullptr) take_from_owner(mutex.object);
  tell_change(mutex.object);
}

}  // namespace

bool is_mine(const pthread_mutex_t& bytes) { return is_mine(reinterpret_cast<const Bytes&>(bytes)); }

int lock(pthread_mutex_t& bytes, Time deadline, bool is_valid_deadline) {
  Bytes& words = words_of(bytes);
  Mutex& mutex = mutex_of(&bytes);
  if (is_mine(words))
    if (const int result = lock_again(words, type_of(bytes)); result >= 0) return result;
  for (std::uint32_t changes = 0;;) {
    if (const int result = take_or_tell(words, mutex, changes); result >= 0) {
      if (result != ENOTRECOVERABLE) note_owner(mutex);
      return result;
    }
    if (!is_valid_deadline) return EINVAL;
    if (deadline <= kernel::running->local_time) return ETIMEDOUT;
    const Wait ended = wait_for_owner(words, mutex, changes, deadline);
    if (ended == Wait::timed_out) return ETIMEDOUT;
    if (ended == Wait::interrupted) handle_signals();
  }
}

int try_lock(pthread_mutex_t& bytes) {
  Bytes& words = words_of(bytes);
  Mutex& mutex = mutex_of(&bytes);
  if (is_mine(words) && type_of(bytes) == PTHREAD_MUTEX_RECURSIVE_NP) return lock_again(words, type_of(bytes));
  if (is_mine(words) && type_of(bytes) == PTHREAD_MUTEX_ERRORCHECK_NP && mutex.is_robust) return EDEADLK;
  std::uint32_t changes = 0;
  const int result = take_or_tell(words, mutex, changes);
  if (result == 0 || result == EOWNERDEAD) note_owner(mutex);
  return result < 0 ? EBUSY : result;
}

int unlock(pthread_mutex_t& bytes) {
  Bytes& words = words_of(bytes);
  Mutex& mutex = mutex_of(&bytes);
  const int type = type_of(bytes);
  const bool is_checked = type == PTHREAD_MUTEX_ERRORCHECK_NP || type == PTHREAD_MUTEX_RECURSIVE_NP || mutex.is_robust;
  if (is_checked && !is_mine(words)) return EPERM;
  if (words.process == 0) return 0;
  if (words.depth > 1) {
    --words.depth;
    return 0;
  }
  give_up(words, mutex, state_after(words));
  return 0;
}

std::uint32_t release(pthread_mutex_t& bytes) {
  Bytes& words = words_of(bytes);
  const std::uint32_t depth = words.depth;
  if (words.process != 0) give_up(words, mutex_of(&bytes), state_after(words));
  return depth;
}

void set_depth(pthread_mutex_t& bytes, std::uint32_t depth) { words_of(bytes).depth = depth; }

int destroy(pthread_mutex_t& bytes) {
  if (words_of(bytes).process != 0) return EBUSY;
  if (Waitable* const known = find_waitable(&bytes, Waitable::Kind::mutex); known != nullptr) forget(*known);
  return 0;
}

void let_go(pthread_mutex_t& bytes) { give_up(words_of(bytes), mutex_of(&bytes), Mutex::RobustState::owner_died); }

int make_consistent(pthread_mutex_t& bytes) {
  Bytes& words = words_of(bytes);
  if (words.robust_state != Mutex::RobustState::inconsistent || !is_mine(words)) return EINVAL;
  words.robust_state = Mutex::RobustState::consistent;
  return 0;
}

}  // namespace waitpoint::posix::shared_mutex
