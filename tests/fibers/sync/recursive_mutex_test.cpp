// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/recursive_mutex.hpp"

#include <gtest/gtest.h>

#include <mutex>
#include <string>
#include <vector>

#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(RecursiveMutex, IsHeldUntilTheLastOfAsManyUnlocks) {
  in_every_order([] {
    recursive_mutex m;
    m.lock();
    m.lock();
    EXPECT_TRUE(m.try_lock());
    const auto others_get_it = [&] {
      bool got = false;
      thread([&] {
        got = m.try_lock();
        if (got) m.unlock();
      }).join();
      return got;
    };
    EXPECT_FALSE(others_get_it());
    m.unlock();
    m.unlock();
    EXPECT_FALSE(others_get_it());
    m.unlock();
    EXPECT_TRUE(others_get_it());
    EXPECT_EQ(now(), Time());
  });
}

TEST(RecursiveMutex, ExcludesOthersInEveryOrder) {
  in_every_order([] {
    recursive_mutex m;
    int inside = 0, total = 0;
    std::vector<thread> threads;
    for (int t = 0; t < 5; ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < 8; ++i) {
          const std::lock_guard outer(m);
          ASSERT_EQ(++inside, 1);
          {
            const std::lock_guard inner(m);
            if ((i + t) % 3 == 0) sleep_for(1ms);
          }
          this_thread::yield();
          ASSERT_EQ(--inside, 0);
          ++total;
        }
      });
    for (thread& t : threads) t.join();
    EXPECT_EQ(total, 40);
  });
}

TEST(RecursiveMutex, ANewOwnerBeginsToCountAnew) {
  in_order([] {
    recursive_mutex m;
    std::string order;
    m.lock();
    m.lock();
    thread waiter([&] {
      m.lock();
      EXPECT_EQ(now(), at(2ms));
      order += 'w';
      m.unlock();
      EXPECT_TRUE(m.try_lock());  // one unlock was enough
      m.unlock();
    });
    sleep_for(1ms);
    m.unlock();
    sleep_for(1ms);
    order += 'm';
    m.unlock();
    waiter.join();
    EXPECT_EQ(order, "mw");
  });
}

TEST(RecursiveTimedMutex, TimesOutOrIsHadInTimeAndItsOwnerNeverWaits) {
  in_every_order([] {
    recursive_timed_mutex m;
    m.lock();
    EXPECT_TRUE(m.try_lock_for(1h));
    EXPECT_TRUE(m.try_lock_for(-1h));
    EXPECT_TRUE(m.try_lock_until(steady_clock::time_point()));
    for (int i = 0; i < 3; ++i) m.unlock();
    EXPECT_EQ(now(), Time());
    thread other([&] {
      EXPECT_FALSE(m.try_lock_for(0s));
      EXPECT_FALSE(m.try_lock_for(2ms));
      EXPECT_EQ(now(), at(2ms));
      EXPECT_FALSE(m.try_lock_until(steady_clock::time_point(4ms)));
      EXPECT_EQ(now(), at(4ms));
      EXPECT_TRUE(m.try_lock_for(10ms));
      EXPECT_EQ(now(), at(6ms));
      m.unlock();
    });
    sleep_for(6ms);
    m.unlock();
    other.join();
  });
}

TEST(RecursiveMutex, StateOfAnotherRunIsForgotten) {
  static recursive_mutex left;
  for (int repeat = 0; repeat < 2; ++repeat) {
    {
      Simulation simulation;
      simulation.spawn(simulation.environment(), {}, [] {
        left.lock();
        left.lock();
        sleep_for(1h);
      });
      EXPECT_EQ(simulation.run_before(at(1ms)), RunEnd::time_reached);
    }
    in_order([] {
      EXPECT_TRUE(left.try_lock());
      left.unlock();
      thread([] {
        EXPECT_TRUE(left.try_lock());
        left.unlock();
      }).join();
    });
  }
}

}  // namespace
}  // namespace waitpoint
