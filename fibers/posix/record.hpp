// SPDX-License-Identifier: BSD-3-Clause
// What `waitpoint exec` and the program that it runs share: a file in memory that both map.
//
// The digest and the scheduler's counts are kept in it, so that they are known up to the last event however the program
// ends, killed or not.
#pragma once

#include <cstdint>
#include <new>

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::posix {

/// The environment variable with the number of its descriptor.
inline constexpr char record_variable[] = "WAITPOINT_EXEC";

/// Exit statuses of a simulated program that are not its own.
inline constexpr int status_of_deadlock = 124, status_of_own_errors = 125;

struct Settings {
  kernel::Order order = kernel::Order::seeded;
  std::uint64_t seed = 1;
};

struct Record {
  static constexpr std::uint64_t mark_of_version = 0x7770657865633031;  // "wpexec01"

  std::uint64_t mark = mark_of_version;
  Settings settings;

  // Written by the program.
  bool began = false;  ///< the scheduler is there
  std::uint32_t threads_made = 0;
  std::uint32_t threads_most = 0;          ///< at once
  kernel::Task* const* running = nullptr;  ///< in the program: where it keeps its running task
  kernel::Robot robot;                     ///< the program
  union {
    kernel::Scheduler scheduler;
  };

  Record() {}
  ~Record() {}  // the scheduler is never taken down: the process ends around it
};

}  // namespace waitpoint::posix
