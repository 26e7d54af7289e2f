// SPDX-License-Identifier: BSD-3-Clause
// Process-shared mutexes: owner and recursion depth are in the program's object. The kernel's list of the objects that
// a thread holds is kept too, for the threads of this process.
#pragma once

#include "fibers/posix/sync/mutex_state.hpp"

namespace waitpoint::posix::shared_mutex {

/// After the caller's waitpoint: as for a private mutex. EINVAL if it would have to wait and the deadline is invalid.
int lock(pthread_mutex_t& bytes, Time deadline, bool is_valid_deadline);
int try_lock(pthread_mutex_t& bytes);
int unlock(pthread_mutex_t& bytes);
/// Unlocks it completely; returns its recursion depth.
std::uint32_t release(pthread_mutex_t& bytes);
void set_depth(pthread_mutex_t& bytes, std::uint32_t depth);
bool is_mine(const pthread_mutex_t& bytes);
/// An error number.
int destroy(pthread_mutex_t& bytes);
/// For a robust mutex: the running thread ends while it holds it.
void let_go(pthread_mutex_t& bytes);
int make_consistent(pthread_mutex_t& bytes);

}  // namespace waitpoint::posix::shared_mutex
