// SPDX-License-Identifier: BSD-3-Clause
// pthread_mutex_t: in its own bytes the type, where glibc has it, and a word that leads to the rest.
#pragma once

#include <pthread.h>

#include "fibers/kernel/ownership.hpp"
#include "fibers/posix/waitable.hpp"
#include "fibers/posix/waiting.hpp"

namespace waitpoint::posix {

struct Mutex : Waitable {
  static constexpr Kind kind_of_all = Kind::mutex;
  static constexpr int robust_bit = 16;  // of glibc's kind
  explicit Mutex(const void* address)
      : Waitable(kind_of_all, "mutex", address),
        is_robust((static_cast<const pthread_mutex_t*>(address)->__data.__kind & robust_bit) != 0) {}

  const bool is_robust;
  std::uint32_t depth = 0;       ///< how often its owner has locked it
  bool owner_died = false;       ///< its next owner is to be told
  bool is_inconsistent = false;  ///< its owner was told, and has not put it right
  bool is_lost = false;          ///< for good: it was unlocked so
};

inline Mutex& mutex_of(pthread_mutex_t* mutex) {
  // The links of the list of robust mutexes, which glibc keeps in the thread's area: we keep none there.
  return waitable_at(reinterpret_cast<Mutex*&>(mutex->__data.__list.__prev), mutex);
}

/// After the caller's waitpoint: an error number; ETIMEDOUT once `deadline` comes first.
int lock(Mutex& mutex, int type, Time deadline);
/// Gives up the mutex that the running thread holds, however often it locked it: the depth that it had.
std::uint32_t release(Mutex& mutex);
inline int type_of(const pthread_mutex_t& mutex) { return mutex.__data.__kind & 3; }

}  // namespace waitpoint::posix
