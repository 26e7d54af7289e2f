// SPDX-License-Identifier: BSD-3-Clause
// Real threads: a semaphore that several threads acquire at once hands out every unit.
#include <gtest/gtest.h>

#include <vector>

#include "fibers/sync/threads.hpp"

namespace waitpoint {
namespace {

TEST(RealSemaphore, GivesEachUnitToOneOfManyWaiters) {
  for (int round = 0; round < 20; ++round) {
    threads::counting_semaphore<> semaphore(0);
    std::vector<threads::thread> all;
    for (int i = 0; i < 4; ++i)
      all.emplace_back([&semaphore] {
        for (int k = 0; k < 200; ++k) semaphore.acquire();
      });
    for (int i = 0; i < 2; ++i)
      all.emplace_back([&semaphore] {
        for (int k = 0; k < 400; ++k) semaphore.release();
      });
    for (threads::thread& thread : all) thread.join();
    EXPECT_FALSE(semaphore.try_acquire());
  }
}

}  // namespace
}  // namespace waitpoint
