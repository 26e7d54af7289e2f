// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/mutex.hpp"

#include <gtest/gtest.h>

#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(Mutex, ExcludesOthersInEveryOrder) {
  in_every_order([] {
    mutex m;
    int inside = 0, total = 0;
    std::vector<thread> threads;
    for (int t = 0; t < 6; ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < 10; ++i) {
          const std::lock_guard guard(m);
          ASSERT_EQ(++inside, 1);
          if ((i + t) % 3 == 0) sleep_for(1ms);
          if ((i + t) % 3 == 1) this_thread::yield();
          ASSERT_EQ(--inside, 0);
          ++total;
        }
      });
    for (thread& t : threads) t.join();
    EXPECT_EQ(total, 60);
  });
}

TEST(Mutex, UncontendedTakesNoTimeAndNoSwitch) {
  const Report report = in_order([] {
    mutex m;
    for (int i = 0; i < 100; ++i) {
      m.lock();
      m.unlock();
      EXPECT_TRUE(m.try_lock());
      m.unlock();
    }
    EXPECT_EQ(now(), Time());
  });
  EXPECT_EQ(report.events, 400u + 3);  // and the task's start, the signal of its end, its end
}

TEST(Mutex, IsHandedToTheFirstWaiterAtTheTimeOfTheUnlock) {
  in_order([] {
    mutex m;
    std::string order;
    std::vector<thread> threads;
    m.lock();
    for (const char name : {'a', 'b', 'c'})
      threads.emplace_back([&, name] {
        sleep_for((name - 'a' + 1) * 1ms);
        m.lock();
        order += name;
        EXPECT_EQ(now(), at((10 + 2 * (name - 'a')) * 1ms));
        sleep_for(2ms);
        m.unlock();
      });
    sleep_for(10ms);
    m.unlock();
    m.lock();  // behind the current waiters
    order += 'm';
    EXPECT_EQ(now(), at(16ms));
    m.unlock();
    for (thread& t : threads) t.join();
    EXPECT_EQ(order, "abcm");
  });
}

TEST(Mutex, TheWaiterServedIsAChoiceInSeededOrders) {
  std::set<std::string> orders;
  for (std::uint64_t number = 1; number <= 60; ++number) {
    std::string order;
    const Report report = simulate(
        [&] {
          mutex m;
          std::vector<thread> threads;
          m.lock();
          for (const char name : {'a', 'b', 'c'})
            threads.emplace_back([&, name] {
              sleep_for((name - 'a' + 1) * 1ms);
              const std::lock_guard guard(m);
              order += name;
            });
          sleep_for(10ms);
          m.unlock();
          for (thread& t : threads) t.join();
        },
        order_number(number));
    ASSERT_TRUE(report.passed) << report;
    orders.insert(order);
  }
  EXPECT_EQ(orders.size(), 6u);
}

TEST(TimedMutex, TriesAtOnceWhereThereIsNoTimeToWait) {
  in_every_order([] {
    timed_mutex m;
    EXPECT_TRUE(m.try_lock_for(0s));
    thread other([&] {
      for (const auto span : {0ns, -1ns, std::chrono::nanoseconds::min()}) EXPECT_FALSE(m.try_lock_for(span));
      EXPECT_FALSE(m.try_lock_for(-1e300s));
      EXPECT_FALSE(m.try_lock_until(steady_clock::now()));
      EXPECT_FALSE(m.try_lock_until(steady_clock::time_point()));
      EXPECT_FALSE(m.try_lock());
      EXPECT_EQ(now(), Time());
    });
    other.join();
    m.unlock();
  });
}

TEST(TimedMutex, GivesUpAtTheDeadlineToTheNanosecond) {
  in_every_order([] {
    timed_mutex m;
    const std::lock_guard guard(m);
    thread other([&] {
      EXPECT_FALSE(m.try_lock_for(5ms));
      EXPECT_EQ(now(), at(5ms));
      EXPECT_FALSE(m.try_lock_until(steady_clock::time_point(7ms + 1ns)));
      EXPECT_EQ(now(), at(7ms + 1ns));
      EXPECT_FALSE(m.try_lock_for(std::chrono::duration<double, std::milli>(1.5)));
      EXPECT_EQ(now(), at(8500us + 1ns));
    });
    other.join();
  });
}

TEST(TimedMutex, IsHadWhenItComesFreeInTime) {
  in_every_order([] {
    timed_mutex m;
    m.lock();
    thread finite([&] {
      EXPECT_TRUE(m.try_lock_for(5ms));
      EXPECT_EQ(now(), at(3ms));
      sleep_for(4ms);
      m.unlock();
    });
    thread infinite([&] {
      sleep_for(4ms);
      EXPECT_TRUE(m.try_lock_for(std::chrono::hours::max()));
      EXPECT_EQ(now(), at(7ms));
      m.unlock();
    });
    sleep_for(3ms);
    m.unlock();
    finite.join();
    infinite.join();
  });
}

TEST(TimedMutex, TimedOutTaskIsNoWaiter) {
  in_every_order([] {
    timed_mutex m;
    m.lock();
    thread gives_up([&] {
      EXPECT_FALSE(m.try_lock_for(2ms));
      sleep_for(100ms);
    });
    thread waits([&] {
      sleep_for(1ms);
      m.lock();
      EXPECT_EQ(now(), at(5ms));
      m.unlock();
    });
    sleep_for(5ms);
    m.unlock();
    waits.join();
    EXPECT_TRUE(m.try_lock());
    m.unlock();
    gives_up.join();
  });
}

TEST(TimedMutex, InTheDefaultOrderATieWithTheDeadlineIsFirstInFirstOut) {
  for (const bool unlock_first : {true, false}) {
    in_order([&] {
      timed_mutex m, never;
      m.lock();
      thread waiter([&] {
        never.lock();
        sleep_for(1ms);
        EXPECT_EQ(m.try_lock_for(4ms), unlock_first);
        if (unlock_first) m.unlock();
        sleep_for(10ms);
        never.unlock();
      });
      // Its own deadline is put into the event list before the waiter's, or after it.
      sleep_for(unlock_first ? 0ms : 2ms);
      if (unlock_first) this_thread::yield();
      EXPECT_FALSE(never.try_lock_until(steady_clock::time_point(5ms)));
      m.unlock();
      waiter.join();
    });
  }
}

}  // namespace
}  // namespace waitpoint
