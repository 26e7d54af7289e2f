// SPDX-License-Identifier: BSD-3-Clause
// A body that fails in one of very many orders.
#pragma once

#include <array>
#include <cstddef>

#include "fibers/explore/check.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {

// Fails only if the reader is in turns before and behind the writer, at each of many variables; else it ends at once.
inline void alternate() {
  constexpr std::size_t stages = 9;
  std::array<atomic<bool>, stages> written;
  std::size_t reached = 0;
  thread writer([&] {
    for (atomic<bool>& stage : written) stage.store(true);
  });
  thread reader([&] {
    while (reached < stages && written[reached].load() == (reached % 2 != 0)) ++reached;
  });
  writer.join();
  reader.join();
  check(reached < stages, "they have alternated");
}

}  // namespace waitpoint
