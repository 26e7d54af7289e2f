// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/timer.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;
using this_thread::sleep_until;

TEST(Timer, FiresOnceAtItsTimeBeforeTheTasksOfThatInstant) {
  in_every_order([] {
    std::vector<Time> fired;
    timer once([&] { fired.push_back(now()); });
    once.start_at(at(5ms));
    EXPECT_TRUE(once.pending());
    EXPECT_EQ(once.due(), at(5ms));
    sleep_until(at(4999us));
    EXPECT_TRUE(fired.empty());
    sleep_until(at(5ms));
    EXPECT_EQ(fired, std::vector{at(5ms)});
    EXPECT_FALSE(once.pending());
    once.start_after(2ms);
    sleep_for(1s);
    EXPECT_EQ(fired.back(), at(7ms));
    // A past time fires now.
    once.start_at(at(1ms));
    this_thread::yield();
    EXPECT_EQ(fired.size(), 3u);
    EXPECT_EQ(fired.back(), at(1005ms));
  });
}

TEST(Timer, RecursAtTheMultiplesOfItsPeriodWithoutDrift) {
  in_every_order([] {
    std::vector<Time> fired;
    timer beat([&] { fired.push_back(now()); });
    sleep_until(at(100ms));
    beat.start_every(Period::hertz(75), 1ms);
    sleep_until(at(10s));
    ASSERT_EQ(fired.size(), 742u);
    for (std::size_t i = 0; i < fired.size(); ++i)
      ASSERT_EQ(fired[i], at(1ms) + Period::hertz(75).tick(static_cast<std::int64_t>(i) + 8));
  });
}

TEST(Timer, ChangesItsPeriodAndStopsAlsoFromItsOwnCallback) {
  in_every_order([] {
    std::vector<std::int64_t> fired;
    timer* self = nullptr;
    timer beat([&] {
      fired.push_back(now().ns() / 1'000'000);
      if (fired.size() == 3) self->start_every(Period::every(25ms));
      if (fired.size() < 5) return;
      EXPECT_TRUE(self->stop());
    });
    self = &beat;
    beat.start_every(Period::every(10ms));
    sleep_for(1s);
    EXPECT_EQ(fired, (std::vector<std::int64_t>{10, 20, 30, 50, 75}));
    EXPECT_FALSE(beat.stop());
    beat.start_after(std::chrono::hours::max());  // infinite: never
    EXPECT_FALSE(beat.pending());
  });
}

TEST(Timer, AStoppedOrDestroyedOneDoesNotFire) {
  in_every_order([] {
    int fired = 0;
    timer stopped([&] { ++fired; });
    stopped.start_after(5ms);
    {
      timer destroyed([&] { ++fired; });
      destroyed.start_after(5ms);
    }
    sleep_until(at(5ms) - Duration::from_ns(1));
    EXPECT_TRUE(stopped.stop());
    sleep_for(1s);
    EXPECT_EQ(fired, 0);
  });
}

TEST(Timer, ItsCallbackReleasesNotifiesAndStartsOtherTimers) {
  in_every_order([] {
    counting_semaphore<> units(0);
    mutex m;
    condition_variable condition;
    bool ready = false;
    timer second([&] {
      ready = true;
      condition.notify_all();
    });
    timer first([&] {
      units.release(2);
      second.start_after(3ms);
    });
    first.start_after(2ms);
    units.acquire();
    units.acquire();
    EXPECT_EQ(now(), at(2ms));
    std::unique_lock lock(m);
    condition.wait(lock, [&] { return ready; });
    EXPECT_EQ(now(), at(5ms));
    EXPECT_TRUE(!units.try_acquire());
  });
}

TEST(Timer, TimersOfOneInstantFireInTheOrderOfTheirFirstStart) {
  in_every_order([] {
    std::string order;
    timer a([&] { order += 'a'; }), b([&] { order += 'b'; }), c([&] { order += 'c'; });
    b.start_at(at(1s));
    c.start_at(at(2s));
    a.start_at(at(1s));
    c.start_at(at(1s));
    sleep_for(1s);
    EXPECT_EQ(order, "bca");
  });
}

TEST(Timer, KeepsNoRunAlive) {
  const Report report = simulate([] {
    static timer for_ever([] {});
    for_ever.start_every(Period::hertz(1000));
    sleep_for(10ms);
  });
  EXPECT_TRUE(report.passed) << report;
  EXPECT_EQ(report.end_time, at(10ms));
}

// Its callback could wake the task, but never does. After a million ticks without effect the run no longer waits for
// it.
TEST(Timer, DoesNotHideADeadlock) {
  const Report report = simulate([] {
    timer beat([] {});
    beat.start_every(Period::hertz(1000));
    counting_semaphore<> never(0, "never");
    never.acquire();
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_NE(report.text.find("never"), std::string::npos) << report;
}

// A sleeping task is not one that waits without end, however often a timer fires meanwhile.
TEST(Timer, GoesOnWhileATaskSleepsLong) {
  in_order([] {
    std::uint32_t fired = 0;
    timer beat([&] { ++fired; });
    beat.start_every(Period::hertz(1000));
    sleep_for(1100s);
    EXPECT_EQ(fired, 1'100'000u);
  });
}

TEST(Timer, EventsArePartOfTheDigestAndRepeat) {
  const auto run = [](std::uint64_t number, std::chrono::microseconds delay) {
    return simulate(
               [&] {
                 timer silent([] {});
                 silent.start_at(at(3ms) + delay);
                 sleep_for(10ms);
               },
               order_number(number))
        .digest;
  };
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    EXPECT_EQ(run(number, 0us).value(), run(number, 0us).value());
    EXPECT_NE(run(number, 0us).value(), run(number, 1us).value());
  }
}

TEST(Timer, StartsAfreshInAnotherRun) {
  static int fired;
  static timer kept([] { ++fired; });
  fired = 0;
  for (int repeat = 0; repeat < 3; ++repeat) {
    Simulation simulation;
    simulation.spawn(simulation.environment(), {}, [] {
      EXPECT_FALSE(kept.pending());
      kept.start_every(Period::every(10ms));
      sleep_for(1s);
    });
    simulation.run_before(at(25ms));
    EXPECT_TRUE(kept.pending());
  }
  EXPECT_EQ(fired, 6);
}

TEST(TimerDeathTest, ACallbackThatWaitsIsABug) {
  const auto run = [](std::function<void()> callback) {
    simulate([&] {
      timer t(callback);
      t.start_after(1ms);
      sleep_for(1s);
    });
  };
  const char* message = "a timer's callback waits";
  EXPECT_DEATH(run([] { sleep_for(1ms); }), message);
  EXPECT_DEATH(run([] { this_thread::yield(); }), message);
  EXPECT_DEATH(run([] { counting_semaphore<>(0).acquire(); }), message);
  EXPECT_DEATH(run([] { throw 1; }), "an exception escapes from a timer's callback");
}

}  // namespace
}  // namespace waitpoint
