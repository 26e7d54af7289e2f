// SPDX-License-Identifier: BSD-3-Clause
// Read-write locks that processes share: who holds one is in its own bytes.
#pragma once

#include <pthread.h>

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::posix::shared_rwlock {

bool is_shared(const pthread_rwlock_t& bytes);

/// After the caller's waitpoint, with what stands for it in this process: as for one that is not shared.
int read_before(pthread_rwlock_t& bytes, kernel::Object& object, Time deadline, bool is_valid_deadline);
int write_before(pthread_rwlock_t& bytes, kernel::Object& object, Time deadline, bool is_valid_deadline);
int unlock(pthread_rwlock_t& bytes, kernel::Object& object);

}  // namespace waitpoint::posix::shared_rwlock
