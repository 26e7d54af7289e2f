// SPDX-License-Identifier: BSD-3-Clause
// What a new task is to be.
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
  LocalClock* clock = nullptr;  ///< must outlive the task; null: only what it declares moves its local time
  Seat* seat = nullptr;         ///< on the processor that it shares; null: it has one of its own
};

}  // namespace waitpoint::kernel
