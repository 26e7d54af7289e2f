// SPDX-License-Identifier: BSD-3-Clause
//
// pthread_spinlock_t: who finds it taken does not spin, but waits.
#include <pthread.h>

#include <cerrno>

#include "fibers/posix/interposed.hpp"
#include "fibers/posix/waiting.hpp"
#include "fibers/posix/word.hpp"

namespace waitpoint::posix {
namespace {

// As glibc's: 1 is free, so that what is not initialised is found out.
constexpr int is_free = 1, is_taken = 0;

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
    // Who unlocks leaves it taken for whom it wakes.
    if (*lock != is_free) return block(word.object, Time::max()) ? 0 : EDEADLK;
  }
  *lock = is_taken;
  return 0;
}

WAITPOINT_INTERPOSED int pthread_spin_trylock(pthread_spinlock_t* lock) noexcept {
  if (is_simulated()) pass(kernel::Operation::try_lock, &word_at(const_cast<const int*>(lock)).object);
  if (*lock != is_free) return EBUSY;
  *lock = is_taken;
  return 0;
}

WAITPOINT_INTERPOSED int pthread_spin_unlock(pthread_spinlock_t* lock) noexcept {
  if (is_simulated()) {
    Word& word = word_at(const_cast<const int*>(lock));
    pass(kernel::Operation::unlock, &word.object);
    if (wake_one(word.object) != nullptr) return 0;
  }
  *lock = is_free;
  return 0;
}
