// SPDX-License-Identifier: BSD-3-Clause
// Operations of condition variables on a mutex that the running thread holds.
#pragma once

#include <pthread.h>

#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/sync/mutex_state.hpp"

namespace waitpoint::posix {

/// After the caller's waitpoint: returns an error number, ETIMEDOUT at `deadline`.
int lock(pthread_mutex_t& mutex, Time deadline);
/// Unlocks a mutex held by the running thread completely; returns its recursion depth.
std::uint32_t release(pthread_mutex_t& mutex);
/// Restores that depth after locking it again.
void set_depth(pthread_mutex_t& mutex, std::uint32_t depth);
/// True if the running thread holds it.
bool is_mine(pthread_mutex_t& mutex);
inline bool inherits_priority(const pthread_mutex_t& mutex) { return (mutex.__data.__kind & 32) != 0; }

}  // namespace waitpoint::posix
