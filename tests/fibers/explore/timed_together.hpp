// SPDX-License-Identifier: BSD-3-Clause
// Helpers of the timed programs.
#pragma once

#include <array>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/explore/timed_programs.hpp"

namespace waitpoint::timed {

using Flag = atomic<int>;

// Runs all of them as threads, and joins them.
template <class... Bodies>
void together(Bodies&&... bodies) {
  std::array<thread, sizeof...(Bodies)> threads = {thread(bodies)...};
  for (thread& t : threads) t.join();
}

}  // namespace waitpoint::timed
