// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/semaphore.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/random.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(Semaphore, GivesAsManyUnitsAsItHas) {
  in_every_order([] {
    counting_semaphore<> s(3);
    EXPECT_TRUE(s.try_acquire());
    s.acquire();
    EXPECT_TRUE(s.try_acquire_for(1h));
    EXPECT_FALSE(s.try_acquire());
    EXPECT_FALSE(s.try_acquire_for(0s));
    EXPECT_FALSE(s.try_acquire_until(steady_clock::time_point()));
    s.release(2);
    EXPECT_TRUE(s.try_acquire());
    EXPECT_TRUE(s.try_acquire());
    EXPECT_FALSE(s.try_acquire());
    EXPECT_EQ(now(), Time());
  });
}

TEST(Semaphore, AReleaseServesWaitersFirstAndKeepsTheRest) {
  in_order([] {
    counting_semaphore<> s(0);
    std::string order;
    std::vector<thread> threads;
    for (const char name : {'a', 'b', 'c'})
      threads.emplace_back([&, name] {
        s.acquire();
        order += name;
      });
    sleep_for(1ms);
    s.release(2);
    EXPECT_FALSE(s.try_acquire());  // both units went to the waiters
    sleep_for(1ms);
    EXPECT_EQ(order, "ab");
    s.release(3);
    sleep_for(1ms);
    EXPECT_EQ(order, "abc");
    EXPECT_TRUE(s.try_acquire());
    EXPECT_TRUE(s.try_acquire());
    EXPECT_FALSE(s.try_acquire());
    for (thread& t : threads) t.join();
  });
}

TEST(Semaphore, UnitsAreConservedInEveryOrder) {
  in_every_order([] {
    counting_semaphore<> s(3);
    int held = 0, most_held = 0, timeouts = 0;
    std::vector<thread> threads;
    for (std::uint64_t t = 0; t < 8; ++t)
      threads.emplace_back([&, t] {
        const RandomStream random(t, "", "units");
        for (std::uint64_t i = 0; i < 20; ++i) {
          const auto span = std::chrono::microseconds(random.below(5, i));
          bool has = true;
          if (i % 3 == 0)
            s.acquire();
          else
            has = i % 3 == 1 ? s.try_acquire() : s.try_acquire_for(span);
          timeouts += !has;
          if (!has) continue;
          most_held = std::max(most_held, ++held);
          sleep_for(span);
          --held;
          s.release();
        }
      });
    for (thread& t : threads) t.join();
    EXPECT_EQ(most_held, 3);
    EXPECT_GT(timeouts, 0);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(s.try_acquire());
    EXPECT_FALSE(s.try_acquire());
  });
}

TEST(Semaphore, TimesOutAtTheDeadlineAndIsNoWaiterAnyMore) {
  in_every_order([] {
    counting_semaphore<> s(0);
    thread other([&] {
      EXPECT_FALSE(s.try_acquire_for(5ms));
      EXPECT_EQ(now(), at(5ms));
      EXPECT_FALSE(s.try_acquire_until(steady_clock::time_point(6ms)));
      EXPECT_EQ(now(), at(6ms));
      sleep_for(100ms);
    });
    sleep_for(10ms);
    s.release();
    EXPECT_TRUE(s.try_acquire());
    other.join();
  });
}

TEST(Semaphore, TimedWaitsAreServedInTime) {
  in_every_order([] {
    binary_semaphore s(0);
    thread other([&] {
      EXPECT_TRUE(s.try_acquire_for(5ms));
      EXPECT_EQ(now(), at(3ms));
      EXPECT_TRUE(s.try_acquire_for(std::chrono::hours::max()));
      EXPECT_EQ(now(), at(6ms));
    });
    sleep_for(3ms);
    s.release();
    sleep_for(3ms);
    s.release();
    other.join();
  });
}

TEST(Semaphore, ReleasedAtTheInstantOfTheDeadlineTheUnitIsNeverLost) {
  expect_both([] {
    counting_semaphore<> s(0);
    bool has = false;
    thread waiter([&] { has = s.try_acquire_for(5ms); });
    sleep_for(5ms);
    s.release();
    waiter.join();
    EXPECT_EQ(s.try_acquire(), !has);
    return has;
  });
}

TEST(Semaphore, HandsTheTurnBackAndForth) {
  in_every_order([] {
    binary_semaphore ping(1), pong(0);
    std::string order;
    thread other([&] {
      for (int i = 0; i < 50; ++i) {
        pong.acquire();
        order += 'o';
        ping.release();
      }
    });
    for (int i = 0; i < 50; ++i) {
      ping.acquire();
      order += 'i';
      pong.release();
    }
    other.join();
    for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i % 2 == 0 ? 'i' : 'o');
    EXPECT_EQ(order.size(), 100u);
  });
}

}  // namespace
}  // namespace waitpoint
