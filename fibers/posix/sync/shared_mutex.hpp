// SPDX-License-Identifier: BSD-3-Clause
// Mutexes that processes share: who holds one, and how often, is in its own bytes. The kernel's record of what a thread
// holds is kept beside, for the threads of this process.
#pragma once

#include "fibers/posix/sync/mutex_state.hpp"

namespace waitpoint::posix::shared_mutex {

/// After the caller's waitpoint: as for one that is not shared. EINVAL where it would have to wait, and the deadline is
/// none.
int lock(pthread_mutex_t& bytes, Time deadline, bool is_valid_deadline);
int try_lock(pthread_mutex_t& bytes);
int unlock(pthread_mutex_t& bytes);
/// Gives it up, however often the running thread locked it: the depth that it had.
std::uint32_t release(pthread_mutex_t& bytes);
void set_depth(pthread_mutex_t& bytes, std::uint32_t depth);
bool is_mine(const pthread_mutex_t& bytes);
/// An error number.
int destroy(pthread_mutex_t& bytes);
/// The running thread ends, and holds it: a robust one.
void let_go(pthread_mutex_t& bytes);
int make_consistent(pthread_mutex_t& bytes);

}  // namespace waitpoint::posix::shared_mutex
