// SPDX-License-Identifier: BSD-3-Clause
// The zoo: small programs with one planted bug each, of the kinds found in robot software and in the known suites of
// concurrency bugs, and their mended twins. The strength of the exploration is measured by them.
//
// A specimen is a template with a parameter that selects the mended twin, which differs in those lines only. Each
// passes in the default order. Their threads interact by primitives and atomics alone, so that no instrumented code is
// needed to find the bugs.
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
  std::uint32_t switches;  ///< the least number of switches away from the default order that show it
  const char* kind;
};

/// All of them, by kind.
const std::vector<Specimen>& specimens();

// One function for each kind, for specimens().
using Specimens = std::vector<Specimen>;
Specimens deadlocks();
Specimens atomicities();
Specimens lock_free();
Specimens orders();
Specimens signals();
Specimens endings();
Specimens robots();
Specimens timings();

/// The threads of a specimen; to be joined before it ends.
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
