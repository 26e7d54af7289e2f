// SPDX-License-Identifier: BSD-3-Clause
// The zoo: small programs with one planted bug each, of the kinds found in robot software and in the known suites of
// concurrency bugs, and their mended twins. They measure the exploration.
//
// A specimen is a template with a parameter `mended`: its twin differs only in those lines. Each passes in the default
// order. Its threads interact at primitives and atomics only, so that no instrumented code is needed to find the bug.
#pragma once

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "fibers/sync/thread.hpp"

namespace waitpoint::zoo {

struct Specimen {
  const char* name;
  void (*buggy)();
  void (*correct)();
  std::uint32_t switches;  ///< the minimum of switches away from the default order
  const char* kind;
  bool is_rare = false;  ///< in so few schedules that no strategy is expected to find it in 10 000
};

/// All specimens, by kind.
const std::vector<Specimen>& specimens();

// One list per kind, for specimens().
using Specimens = std::vector<Specimen>;
Specimens deadlocks();
Specimens atomicities();
Specimens lock_free();
Specimens orders();
Specimens signals();
Specimens endings();
Specimens robots();
Specimens timings();
Specimens hard();

/// The threads of a specimen; join before its end.
class Crew {
 public:
  template <class Function>
  void add(const char* name, Function function) {
    threads_.emplace_back(thread_attributes{.name = name, .stack = kernel::StackSize::small}, std::move(function));
  }
  void join() {
    for (thread& member : threads_) member.join();
    threads_.clear();
  }

 private:
  std::deque<thread> threads_;
};

}  // namespace waitpoint::zoo
