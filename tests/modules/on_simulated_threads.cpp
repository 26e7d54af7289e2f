// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "fibers/sync/simulation.hpp"
#include "tests/modules/on_threads.hpp"

namespace waitpoint {

void on_threads(const std::function<void()>& body) {
  for (std::uint64_t seed = 0; seed <= 10; ++seed) {
    const Report report = simulate(body, {seed == 0 ? kernel::Order::fifo : kernel::Order::seeded, seed, ""});
    EXPECT_TRUE(report.passed) << report;
  }
}

}  // namespace waitpoint
