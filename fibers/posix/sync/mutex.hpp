// SPDX-License-Identifier: BSD-3-Clause
// What conditions do with a mutex that the running thread holds.
#pragma once

#include <pthread.h>

#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/sync/mutex_state.hpp"

namespace waitpoint::posix {

/// After the caller's waitpoint: an error number; ETIMEDOUT once `deadline` comes first.
int lock(pthread_mutex_t& mutex, Time deadline);
/// Gives up the mutex that the running thread holds, however often it locked it: the depth that it had.
std::uint32_t release(pthread_mutex_t& mutex);
/// Of one that is locked again after that.
void set_depth(pthread_mutex_t& mutex, std::uint32_t depth);
/// Whether the running thread holds it.
bool is_mine(pthread_mutex_t& mutex);
inline bool inherits_priority(const pthread_mutex_t& mutex) { return (mutex.__data.__kind & 32) != 0; }

}  // namespace waitpoint::posix
