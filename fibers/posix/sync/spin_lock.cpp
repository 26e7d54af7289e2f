// SPDX-License-Identifier: BSD-3-Clause
//
// pthread_spinlock_t: a thread that finds it taken waits instead of spinning.
#include <pthread.h>

#include <cerrno>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/word.hpp"
#include "fibers/posix/sync/shared_object.hpp"

namespace waitpoint::posix {
namespace {

// As in glibc: 1 is free, so that an uninitialised lock shows.
constexpr int is_free = 1, is_taken = 0;
static_assert(sizeof(pthread_spinlock_t) == sizeof(int));

bool take(pthread_spinlock_t* lock) { return __atomic_exchange_n(lock, is_taken, __ATOMIC_SEQ_CST) == is_free; }

bool is_left(const void* lock) { return __atomic_load_n(static_cast<const int*>(lock), __ATOMIC_SEQ_CST) == is_free; }

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_spin_init(pthread_spinlock_t* lock, int) noexcept {
  *lock = is_free;
  return 0;
}

WAITPOINT_INTERPOSED int pthread_spin_destroy(pthread_spinlock_t*) noexcept { return 0; }

WAITPOINT_INTERPOSED int pthread_spin_lock(pthread_spinlock_t* lock) noexcept {
  if (is_simulated()) {
    Word& word = word_at(const_cast<const int*>(lock));
    pass(kernel::Operation::lock, &word.object);
    while (!take(lock))
      if (wait_on_shared(word.object, Time::max(), is_left, const_cast<const int*>(lock)) == Wait::interrupted)
        handle_signals();
    return 0;
  }
  *lock = is_taken;
  return 0;
}

WAITPOINT_INTERPOSED int pthread_spin_trylock(pthread_spinlock_t* lock) noexcept {
  if (is_simulated()) pass(kernel::Operation::try_lock, &word_at(const_cast<const int*>(lock)).object);
  return take(lock) ? 0 : EBUSY;
}

WAITPOINT_INTERPOSED int pthread_spin_unlock(pthread_spinlock_t* lock) noexcept {
  if (is_simulated()) {
    Word& word = word_at(const_cast<const int*>(lock));
    pass(kernel::Operation::unlock, &word.object);
    __atomic_store_n(lock, is_free, __ATOMIC_SEQ_CST);
    tell_change(word.object);
    return 0;
  }
  *lock = is_free;
  return 0;
}
