// SPDX-License-Identifier: BSD-3-Clause
// pthread_mutex_t: in its own bytes the type, where glibc has it, and a word that leads to the rest.
#pragma once

#include <pthread.h>

#include "fibers/posix/program/waitable.hpp"

namespace waitpoint::posix {

struct Mutex : Waitable {
  static constexpr Kind kind_of_all = Kind::mutex;
  static constexpr int robust_bit = 16, shared_bit = 128;  // of glibc's kind
  explicit Mutex(const void* address)
      : Waitable(kind_of_all, "mutex", address),
        is_robust((static_cast<const pthread_mutex_t*>(address)->__data.__kind & robust_bit) != 0),
        is_shared((static_cast<const pthread_mutex_t*>(address)->__data.__kind & shared_bit) != 0) {}

  /// POSIX: of what a robust mutex protects.
  enum class RobustState : std::uint8_t {
    consistent,
    owner_died,     ///< its next owner is to be told: EOWNERDEAD
    inconsistent,   ///< its owner was told, and has not called pthread_mutex_consistent
    unrecoverable,  ///< it was unlocked inconsistent: ENOTRECOVERABLE
  };

  const bool is_robust;
  const bool is_shared;  ///< between processes: what follows is in its own bytes, see shared_mutex.hpp
  RobustState robust_state = RobustState::consistent;
  std::uint32_t depth = 0;  ///< how often its owner has locked it
};

inline bool is_shared(const pthread_mutex_t& mutex) { return (mutex.__data.__kind & Mutex::shared_bit) != 0; }

inline int type_of(const pthread_mutex_t& mutex) { return mutex.__data.__kind & 3; }

inline Mutex& mutex_of(pthread_mutex_t* mutex) {
  if (is_shared(*mutex)) return waitable_at<Mutex>(mutex);
  // The links of the list of robust mutexes, which glibc keeps in the thread's area: we keep none there.
  return waitable_at(reinterpret_cast<Mutex*&>(mutex->__data.__list.__prev), mutex);
}

}  // namespace waitpoint::posix
