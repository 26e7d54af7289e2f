// SPDX-License-Identifier: BSD-3-Clause
// Process-shared read-write locks: the holders are in the program's object.
#pragma once

#include <pthread.h>

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::posix::shared_rwlock {

bool is_shared(const pthread_rwlock_t& bytes);

/// After the caller's waitpoint, with the lock's object in this process: as for a private lock.
int read_before(pthread_rwlock_t& bytes, kernel::Object& object, Time deadline, bool is_valid_deadline);
int write_before(pthread_rwlock_t& bytes, kernel::Object& object, Time deadline, bool is_valid_deadline);
int unlock(pthread_rwlock_t& bytes, kernel::Object& object);

}  // namespace waitpoint::posix::shared_rwlock
