// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <vector>

#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

TEST(ManyTasks, TwentyThousandRunAtOnce) {
  for (std::uint64_t number = 0; number <= 1; ++number) {
    constexpr int count = 20'000;
    int at_once = 0, most_at_once = 0, sum = 0;
    const Report report = simulate(
        [&] {
          mutex m;
          std::vector<thread> threads;
          for (int i = 0; i < count; ++i)
            threads.emplace_back(thread_attributes{.stack = kernel::StackSize::small}, [&, i] {
              most_at_once = std::max(most_at_once, ++at_once);
              for (int k = 0; k < 3; ++k) this_thread::sleep_for(std::chrono::microseconds(1 + (i * 7919 + k) % 1000));
              const std::lock_guard guard(m);
              sum += i;
              --at_once;
            });
          for (thread& t : threads) t.join();
        },
        order_number(number));
    EXPECT_TRUE(report.passed) << report;
    EXPECT_EQ(most_at_once, count);
    EXPECT_EQ(sum, count / 2 * (count - 1));
    EXPECT_GT(report.events, 7u * count);
  }
}

TEST(ManyTasks, AreUnwoundInTheMiddle) {
  constexpr int count = 20'000;
  int left = 0;
  {
    Simulation simulation;
    simulation.spawn(simulation.environment(), {}, [&] {
      counting_semaphore<> never(0);
      struct Leaves {
        ~Leaves() { ++left; }
        int& left;
      };
      for (int i = 0; i < count; ++i)
        thread({.stack = kernel::StackSize::small}, [&] {
          const Leaves leaves{left};
          never.acquire();
        }).detach();
      this_thread::sleep_for(1h);
    });
    EXPECT_EQ(simulation.run_before(Time() + Duration(1ms)), RunEnd::time_reached);
  }
  EXPECT_EQ(left, count);
}

}  // namespace
}  // namespace waitpoint
