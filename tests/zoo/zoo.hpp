// SPDX-License-Identifier: BSD-3-Clause
// The zoo: small programs with a planted bug each, of the kinds that robot software and the known suites of concurrency
// bugs have, and the same programs mended. What exploration is worth is measured by them.
//
// A specimen is a template whose parameter says whether it is mended: a twin differs in those lines only. Each passes
// in the default order. They meet at primitives and atomics alone, so that no instrumented code is needed to find them.
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
  std::uint32_t switches;  ///< away from the default order, the fewest that show it
  const char* kind;
};

/// All of them, by kind.
const std::vector<Specimen>& specimens();

// Of one kind each, for specimens().
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
