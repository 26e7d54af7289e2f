// SPDX-License-Identifier: BSD-3-Clause
// Waits of the family's threads, in its memory, while one of its processes asks for them: core/lasting_wait.hpp.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

/// Scope of the running thread's wait for a lock, without a limit, which is noted if waits are.
class NotedWait {
 public:
  explicit NotedWait(const kernel::Task& owner);
  ~NotedWait();
  NotedWait(const NotedWait&) = delete;
  NotedWait& operator=(const NotedWait&) = delete;

 private:
  int place_ = -1;
};

}  // namespace waitpoint::posix
