// SPDX-License-Identifier: BSD-3-Clause
// What a process says of itself when the process that watches the run asks (signals.hpp, is_question): one process at a
// time, in memory that both see.
#pragma once

#include <atomic>
#include <cstdint>

namespace waitpoint::posix::family {

struct Account {
  static constexpr int places_max = 8;
  /// A call of the running thread's, by its module's file and the offset in it.
  struct Place {
    char module[256];
    char function[128];
    std::uintptr_t offset;
  };
  std::atomic<bool> is_written = false;
  char states[16384] = {};  ///< a line for each thread
  char running[128] = {};   ///< the thread that computes; empty if none does
  int place_count = 0;      ///< of its calls, innermost first
  Place places[places_max] = {};
};

}  // namespace waitpoint::posix::family
