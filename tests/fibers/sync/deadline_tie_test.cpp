// SPDX-License-Identifier: BSD-3-Clause
// An unlock at the very instant of the deadline is a tie: either may come first, and both outcomes are correct.
#include <gtest/gtest.h>

#include "fibers/sync/mutex.hpp"
#include "fibers/sync/priority_mutex.hpp"
#include "fibers/sync/recursive_mutex.hpp"
#include "fibers/sync/shared_mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

template <class Mutex>
class DeadlineTie : public testing::Test {};
using TimedMutexes = testing::Types<timed_mutex, recursive_timed_mutex, priority_mutex, shared_timed_mutex>;
TYPED_TEST_SUITE(DeadlineTie, TimedMutexes);

TYPED_TEST(DeadlineTie, WaiterEitherTakesTheLockOrLeavesItFree) {
  expect_both([] {
    TypeParam m;
    m.lock();
    bool has = false;
    thread waiter([&] {
      has = m.try_lock_for(5ms);
      EXPECT_EQ(now(), Time() + 5ms);
      if (has) m.unlock();
    });
    this_thread::sleep_for(5ms);
    m.unlock();
    waiter.join();
    EXPECT_TRUE(m.try_lock());
    m.unlock();
    return has;
  });
}

}  // namespace
}  // namespace waitpoint
