// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/periodic_timer.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;
using this_thread::sleep_until;

TEST(PeriodicTimer, TicksAt75HertzToTheNanosecond) {
  in_every_order([] {
    periodic_timer timer(Period::hertz(75));
    for (std::int64_t k = 1; k <= 150; ++k) {
      ASSERT_EQ(timer.wait(), 1);
      ASSERT_EQ(now(), at(Period::hertz(75).tick(k)));
      ASSERT_EQ(timer.due(), now());
    }
    EXPECT_EQ(now(), at(2s));
  });
}

TEST(PeriodicTimer, MissedTicksAreCountedAndDoNotPileUp) {
  in_every_order([] {
    periodic_timer timer(Period::every(10ms));
    EXPECT_EQ(timer.wait(), 1);
    sleep_until(at(35ms));
    EXPECT_EQ(timer.wait(), 2);  // those of 20 and 30 ms, at once
    EXPECT_EQ(now(), at(35ms));
    EXPECT_EQ(timer.due(), at(30ms));
    EXPECT_EQ(timer.wait(), 1);
    EXPECT_EQ(now(), at(40ms));
    compute(25ms);
    EXPECT_EQ(timer.wait(), 2);
    EXPECT_EQ(now(), at(65ms));
    sleep_until(at(1s));
    EXPECT_EQ(timer.wait(), 94);  // including the one of this instant
    EXPECT_EQ(timer.due(), at(1s));
    EXPECT_EQ(timer.wait(), 1);
    EXPECT_EQ(now(), at(1010ms));
  });
}

TEST(PeriodicTimer, IsCountedFromTheStartOfTheRunWheneverItIsFirstWaitedFor) {
  in_every_order([] {
    sleep_until(at(12ms));
    periodic_timer late(Period::every(10ms)), shifted(Period::every(10ms), 3ms), far(Period::every(10ms), 1s);
    sleep_until(at(14ms));
    EXPECT_EQ(late.wait(), 1);
    EXPECT_EQ(now(), at(20ms));
    EXPECT_EQ(shifted.wait(), 1);
    EXPECT_EQ(now(), at(23ms));
    EXPECT_EQ(far.wait(), 1);
    EXPECT_EQ(now(), at(1s));
    periodic_timer from_a_tick(Period::every(10ms));
    EXPECT_EQ(from_a_tick.wait(), 1);
    EXPECT_EQ(now(), at(1010ms));
  });
}

TEST(PeriodicTimer, EqualPeriodsTickTogetherBeforeTheTasksOfThatInstant) {
  in_order([] {
    std::string order;
    std::vector<thread> threads;
    thread sleeper([&] {
      sleep_until(at(20ms));
      order += 's';
    });
    for (const char name : {'a', 'b'})
      threads.emplace_back([&, name] {
        sleep_for(name == 'a' ? 5ms : 1ms);
        periodic_timer timer(Period::every(20ms));
        timer.wait();
        EXPECT_EQ(now(), at(20ms));
        order += name;
      });
    sleeper.join();
    for (thread& t : threads) t.join();
    // The timers fire first; the tasks that they wake come after those that were already due.
    EXPECT_EQ(order, "sba");
  });
}

TEST(PeriodicTimer, ServesItsWaitersInTurn) {
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    std::string order;
    const Report report = simulate(
        [&] {
          periodic_timer timer(Period::every(10ms));
          std::vector<thread> threads;
          for (const char name : {'a', 'b', 'c'})
            threads.emplace_back([&, name] {
              sleep_for((name - 'a' + 1) * 1ms);
              EXPECT_EQ(timer.wait(), 1);
              order += name + std::to_string(now().ns() / 10'000'000);
            });
          for (thread& t : threads) t.join();
        },
        order_number(number));
    ASSERT_TRUE(report.passed) << report;
    EXPECT_EQ(order, "a1b2c3");
  }
}

TEST(PeriodicTimer, TimedWaitsEndAtTheDeadlineOrWithATick) {
  in_every_order([] {
    periodic_timer timer(Period::every(10ms));
    EXPECT_EQ(timer.wait_for(4ms), 0);
    EXPECT_EQ(now(), at(4ms));
    EXPECT_EQ(timer.try_wait(), 0);
    EXPECT_EQ(timer.wait_for(20ms), 1);
    EXPECT_EQ(now(), at(10ms));
    EXPECT_EQ(timer.wait_for(10ms), 1);  // a tick at the instant of the deadline comes before it
    EXPECT_EQ(now(), at(20ms));
    EXPECT_EQ(timer.wait_until(steady_clock::time_point(30ms - 1ns)), 0);
    EXPECT_EQ(timer.wait_for(0s), 0);
    sleep_until(at(55ms));
    EXPECT_EQ(timer.try_wait(), 3);
    EXPECT_EQ(timer.due(), at(50ms));
    EXPECT_EQ(timer.missed(), 2);
    EXPECT_EQ(timer.wait_for(std::chrono::hours::max()), 1);
    EXPECT_EQ(now(), at(60ms));
  });
}

TEST(PeriodicTimer, ChangesItsPeriodWhileTasksWait) {
  in_every_order([] {
    periodic_timer timer(Period::every(10ms));
    std::vector<Time> ticks;
    thread other([&] {
      for (int i = 0; i < 4; ++i) {
        timer.wait();
        ticks.push_back(now());
      }
    });
    sleep_until(at(15ms));
    timer.set_period(Period::every(7ms), 1ms);
    other.join();
    EXPECT_EQ(ticks, (std::vector{at(10ms), at(22ms), at(29ms), at(36ms)}));
    sleep_until(at(45ms));
    timer.set_period(Period::every(100ms));
    EXPECT_EQ(timer.wait(), 1);  // of 43 ms: a tick is kept
    EXPECT_EQ(timer.due(), at(43ms));
    EXPECT_EQ(timer.wait(), 1);
    EXPECT_EQ(now(), at(100ms));
  });
}

TEST(PeriodicTimer, StopWakesWaitersAndTheTimerCanRestart) {
  in_every_order([] {
    periodic_timer timer(Period::every(10ms));
    thread other([&] {
      EXPECT_EQ(timer.wait(), 1);
      EXPECT_EQ(timer.wait(), 0);
      EXPECT_EQ(now(), at(15ms));
      EXPECT_EQ(timer.wait(), 0);
    });
    sleep_until(at(15ms));
    timer.stop();
    other.join();
    sleep_until(at(100ms));
    EXPECT_EQ(timer.try_wait(), 0);
    timer.set_period(Period::every(10ms));
    EXPECT_EQ(timer.wait(), 1);
    EXPECT_EQ(now(), at(110ms));
  });
}

// Ticks are not tasks: a run with nothing but timers is deadlocked.
TEST(PeriodicTimer, TimerWithoutWaitersKeepsNoRunAlive) {
  const Report report = simulate([] {
    periodic_timer timer(Period::hertz(50));
    timer.wait();
    counting_semaphore<> never(0, "never");
    never.acquire();
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_NE(report.text.find("never"), std::string::npos) << report;
  EXPECT_EQ(report.end_time, at(20ms));
}

TEST(PeriodicTimer, MayBeDestroyedWhileItsTickIsDueAndAfterItsRun) {
  static std::optional<periodic_timer> kept;
  for (int repeat = 0; repeat < 3; ++repeat) {
    kept.emplace(Period::every(10ms));
    {
      Simulation simulation;
      simulation.spawn(simulation.environment(), {}, [] {
        periodic_timer inner(Period::every(5ms));
        inner.wait();
        kept->wait();
      });
      EXPECT_EQ(simulation.run_before(at(7ms)), RunEnd::time_reached);
      if (repeat == 1) kept.reset();
    }
  }
  // In another run it starts anew.
  for (int repeat = 0; repeat < 2; ++repeat)
    in_order([] {
      sleep_until(at(3ms));
      EXPECT_EQ(kept->wait(), 1);
      EXPECT_EQ(now(), at(10ms));
    });
  kept.reset();
}

TEST(PeriodicTimerDeathTest, DestroyingOneThatATaskWaitsForIsABug) {
  EXPECT_DEATH(simulate([] {
                 auto timer = std::make_unique<periodic_timer>(Period::every(10ms));
                 thread waiter([&] { timer->wait(); });
                 sleep_until(at(1ms));
                 timer.reset();
               }),
               "destroyed while tasks wait for it: timer #");
}

}  // namespace
}  // namespace waitpoint
