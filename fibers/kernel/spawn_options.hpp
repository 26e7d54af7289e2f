// SPDX-License-Identifier: BSD-3-Clause
// The properties of a new task.
#pragma once

#include "fibers/kernel/event.hpp"
#include "fibers/switch/stack.hpp"

namespace waitpoint::kernel {

struct LocalClock;
struct Seat;

struct SpawnOptions {
  const char* name = "task";  ///< cut to 47 characters
  StackSize stack = StackSize::medium;
  Phase phase = Phase::tasks;
  bool service = false;
  LocalClock* clock = nullptr;  ///< must outlive the task; null: only declared costs advance its local time
  Seat* seat = nullptr;         ///< on a shared processor; null: a processor of its own
};

}  // namespace waitpoint::kernel
