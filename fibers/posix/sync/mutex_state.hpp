// SPDX-License-Identifier: BSD-3-Clause
// pthread_mutex_t: the program's object holds the type, where glibc has it, and a pointer to the waitable.
#pragma once

#include <pthread.h>

#include <cstddef>

#include "fibers/posix/program/waitable.hpp"

namespace waitpoint::posix {

struct Mutex : Waitable {
  static constexpr Kind kind_of_all = Kind::mutex;
  static constexpr int robust_bit = 16, shared_bit = 128;  // of glibc's kind
  explicit Mutex(const void* address)
      : Waitable(kind_of_all, "mutex", address),
        is_robust((static_cast<const pthread_mutex_t*>(address)->__data.__kind & robust_bit) != 0),
        is_shared((static_cast<const pthread_mutex_t*>(address)->__data.__kind & shared_bit) != 0) {}

  /// POSIX: the state of the data that a robust mutex protects.
  enum class RobustState : std::uint8_t {
    consistent,
    owner_died,     ///< the next lock returns EOWNERDEAD
    inconsistent,   ///< its owner got EOWNERDEAD, and has not called pthread_mutex_consistent
    unrecoverable,  ///< unlocked while inconsistent: ENOTRECOVERABLE
  };

  const bool is_robust;
  const bool is_shared;  ///< between processes: the members below are in the program's object, see shared_mutex.hpp
  RobustState robust_state = RobustState::consistent;
  std::uint32_t depth = 0;  ///< number of locks by its owner
};

static_assert((PTHREAD_MUTEX_TIMED_NP | PTHREAD_MUTEX_RECURSIVE_NP | PTHREAD_MUTEX_ERRORCHECK_NP |
               PTHREAD_MUTEX_ADAPTIVE_NP) == 3 &&
              ((Mutex::robust_bit | Mutex::shared_bit) & 3) == 0);
static_assert(offsetof(pthread_mutex_t, __data.__list.__prev) % alignof(void*) == 0 &&
              sizeof(pthread_mutex_t::__data.__list) == 2 * sizeof(void*));

/// As glibc marks it: all calls but pthread_mutex_init() fail with EINVAL then.
inline constexpr int kind_of_destroyed = -1;
inline bool is_destroyed(const pthread_mutex_t& mutex) { return mutex.__data.__kind == kind_of_destroyed; }

inline bool is_shared(const pthread_mutex_t& mutex) { return (mutex.__data.__kind & Mutex::shared_bit) != 0; }

inline int type_of(const pthread_mutex_t& mutex) { return mutex.__data.__kind & 3; }

inline Mutex& mutex_of(pthread_mutex_t* mutex) {
  if (is_shared(*mutex)) return waitable_at<Mutex>(mutex);
  // glibc's link in its thread's list of robust mutexes, which the layer does not use.
  return waitable_at(reinterpret_cast<Mutex*&>(mutex->__data.__list.__prev), mutex);
}

}  // namespace waitpoint::posix
