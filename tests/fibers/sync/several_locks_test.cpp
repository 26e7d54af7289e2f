// SPDX-License-Identifier: BSD-3-Clause
// Several locks at once: std::lock, std::try_lock and std::scoped_lock of the standard library with this library's
// mutexes, without deadlocks, and without spinning while virtual time does not advance.
#include <gtest/gtest.h>

#include <memory>
#include <mutex>
#include <shared_mutex>
#include <vector>

#include "fibers/sync/mutex.hpp"
#include "fibers/sync/priority_mutex.hpp"
#include "fibers/sync/recursive_mutex.hpp"
#include "fibers/sync/shared_mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(SeveralLocks, PhilosophersTakingBothForksAtOnceAllEat) {
  in_every_order([] {
    constexpr std::size_t count = 5;
    std::vector<std::unique_ptr<mutex>> forks;
    for (std::size_t i = 0; i < count; ++i) forks.push_back(std::make_unique<mutex>());
    std::vector<int> in_use(count), meals(count);
    std::vector<thread> philosophers;
    for (std::size_t i = 0; i < count; ++i)
      philosophers.emplace_back([&, i] {
        const std::size_t left = i, right = (i + 1) % count;
        for (int meal = 0; meal < 6; ++meal) {
          const std::scoped_lock both(*forks[left], *forks[right]);
          EXPECT_EQ(++in_use[left], 1);
          EXPECT_EQ(++in_use[right], 1);
          if (meal % 2 == 0) sleep_for(1ms);
          this_thread::yield();
          --in_use[left], --in_use[right];
          ++meals[i];
        }
      });
    for (thread& t : philosophers) t.join();
    EXPECT_EQ(meals, std::vector<int>(count, 6));
    // Each sleeps 3 ms, and at most two eat at a time.
    EXPECT_GE(now(), Time() + Duration(8ms));
    EXPECT_LE(now(), Time() + Duration(15ms));
  });
}

// The same four in opposite orders.
TEST(SeveralLocks, LocksAllKindsInAnyOrder) {
  in_every_order([] {
    mutex plain;
    recursive_timed_mutex recursive;
    shared_mutex shared;
    priority_mutex urgent;
    int inside = 0, total = 0;
    const auto use = [&] {
      EXPECT_EQ(++inside, 1);
      sleep_for(100us);
      EXPECT_EQ(--inside, 0);
      ++total;
    };
    std::vector<thread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < 5; ++i) {
          if (t % 2 == 0) {
            const std::scoped_lock all(plain, recursive, shared, urgent);
            use();
          } else {
            std::lock(urgent, shared, recursive, plain);
            const std::scoped_lock all(std::adopt_lock, plain, recursive, shared, urgent);
            use();
          }
        }
      });
    for (thread& t : threads) t.join();
    EXPECT_EQ(total, 20);
    EXPECT_EQ(now(), Time() + Duration(2ms));
  });
}

TEST(SeveralLocks, TryingSaysWhichCannotBeHadAndHoldsNone) {
  in_every_order([] {
    mutex first, second;
    shared_mutex third;
    third.lock_shared();
    thread([&] {
      std::unique_lock a(first, std::defer_lock), b(second, std::defer_lock);
      std::unique_lock c(third, std::defer_lock);
      EXPECT_EQ(std::try_lock(a, b, c), 2);
      EXPECT_FALSE(a.owns_lock() || b.owns_lock() || c.owns_lock());
      std::shared_lock reads(third, std::defer_lock);
      EXPECT_EQ(std::try_lock(a, b, reads), -1);
    }).join();
    third.unlock_shared();
    EXPECT_TRUE(first.try_lock() && second.try_lock());
    first.unlock(), second.unlock();
    EXPECT_EQ(now(), Time());
  });
}

// Waiting for one lock while holding no other cannot close a cycle.
TEST(SeveralLocks, WaitForOneThatIsHeldWithoutHoldingTheOthers) {
  in_every_order([] {
    mutex first, second;
    second.lock();
    thread both([&] {
      const std::scoped_lock locks(first, second);
      EXPECT_EQ(now(), Time() + Duration(10ms));
    });
    sleep_for(5ms);
    EXPECT_TRUE(first.try_lock());
    first.unlock();
    sleep_for(5ms);
    second.unlock();
    both.join();
  });
}

}  // namespace
}  // namespace waitpoint
