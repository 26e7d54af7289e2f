// SPDX-License-Identifier: BSD-3-Clause
// What the timed programs have in common.
#pragma once

#include <array>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/explore/timed_programs.hpp"

namespace waitpoint::timed {

using Flag = atomic<int>;

// Runs all of them as threads, and waits for their ends.
template <class... Bodies>
void together(Bodies&&... bodies) {
  std::array<thread, sizeof...(Bodies)> threads = {thread(bodies)...};
  for (thread& t : threads) t.join();
}

/// By their kind: what must be done before something else; what must not be done at the same time.
extern const std::vector<Program> orders;
extern const std::vector<Program> exclusions;

}  // namespace waitpoint::timed
