// SPDX-License-Identifier: BSD-3-Clause
// A run in which virtual time does not advance ends with a report that names the task responsible.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "fibers/sync/timer.hpp"
#include "tests/fibers/sync/orders.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(NoProgress, TasksThatSpinAtOneInstantAreNamed) {
  for (std::uint64_t number = 0; number <= 1; ++number) {
    const Report report = simulate(
        [] {
          sleep_for(2ms);
          mutex m("busy");
          m.lock();
          thread spinner({.name = "spinner"}, [&] {
            while (!m.try_lock()) {
            }
          });
          for (;;) this_thread::yield();
        },
        order_number(number));
    EXPECT_EQ(report.end, RunEnd::no_progress);
    EXPECT_TRUE(contains(report.text, "no progress: virtual time stands still at 0.002000000 s")) << report;
    EXPECT_TRUE(contains(report.text, "task spinner of environment (")) << report;
    EXPECT_TRUE(contains(report.text, "task main of environment (yield)")) << report;
  }
}

TEST(NoProgress, NamesATaskThatPollsTheClock) {
  for (std::uint64_t number = 0; number <= 1; ++number) {
    const Report report = simulate(
        [] {
          sleep_for(2ms);
          const auto end = steady_clock::now() + 1ms;
          while (steady_clock::now() < end) {
          }
        },
        order_number(number));
    EXPECT_EQ(report.end, RunEnd::no_progress);
    EXPECT_TRUE(contains(report.text, "task main of environment")) << report;
  }
}

TEST(NoProgress, PollingTheClockLetsOtherTasksRun) {
  in_every_order([] {
    bool done = false;
    thread other([&] {
      sleep_for(0ms);
      done = true;
    });
    while (!done) (void)system_clock::now();
    other.join();
    // Its own time advances while it computes.
    for (const Time end = now() + 20ms; now() < end;) compute(1us);
    EXPECT_EQ(now(), Time() + 20ms);
  });
}

// More waitpoints than idle tasks may pass at one instant.
constexpr int many_items = 8'000'000;

TEST(NoProgress, IsNotSaidOfTasksThatExchangeUnitsAtOneInstant) {
  const Report report = simulate([] {
    counting_semaphore<> full(0), empty(1);
    thread consumer([&] {
      for (int item = 0; item < many_items; ++item) {
        full.acquire();
        empty.release();
      }
    });
    for (int item = 0; item < many_items; ++item) {
      empty.acquire();
      full.release();
    }
    consumer.join();
  });
  EXPECT_TRUE(report.passed) << report;
  EXPECT_EQ(report.end_time, Time());
}

TEST(NoProgress, IsNotSaidOfABoundedBufferAtOneInstant) {
  const Report report = simulate([] {
    mutex m;
    condition_variable not_full, not_empty;
    int stored = 0;
    thread consumer([&] {
      for (int item = 0; item < many_items; ++item) {
        std::unique_lock lock(m);
        not_empty.wait(lock, [&] { return stored > 0; });
        --stored;
        not_full.notify_one();
      }
    });
    for (int item = 0; item < many_items; ++item) {
      std::unique_lock lock(m);
      not_full.wait(lock, [&] { return stored < 16; });
      ++stored;
      not_empty.notify_one();
    }
    consumer.join();
  });
  EXPECT_TRUE(report.passed) << report;
  EXPECT_EQ(report.end_time, Time());
}

TEST(NoProgress, AnExchangeWithoutEndIsNamedAtTheLimitOfAnInstant) {
  for (std::uint64_t number = 0; number <= 1; ++number) {
    SimulationOptions options = order_number(number);
    options.instant_limit = 1'000'000;
    const Report report = simulate(
        [] {
          sleep_for(2ms);
          counting_semaphore<> there(0, "there"), back(0, "back");
          thread other({.name = "other"}, [&] {
            for (;;) {
              there.acquire();
              back.release();
            }
          });
          for (;;) {
            there.release();
            back.acquire();
          }
        },
        options);
    EXPECT_EQ(report.end, RunEnd::no_progress);
    EXPECT_TRUE(contains(report.text,
                         "no progress: virtual time stands still at 0.002000000 s while tasks pass more waitpoints"))
        << report;
    EXPECT_TRUE(contains(report.text, "task main of environment")) << report;
    EXPECT_TRUE(contains(report.text, "task other of environment")) << report;
  }
}

TEST(NoProgress, LocksHandedOverAndZeroTimeoutsAreNone) {
  const Report report = simulate([] {
    mutex m;
    counting_semaphore<> never(0);
    const auto poll = [&] {
      for (;;) {
        const std::lock_guard lock(m);
        if (never.try_acquire_for(0s)) break;
      }
    };
    thread other({.name = "other"}, poll);
    poll();
  });
  EXPECT_EQ(report.end, RunEnd::no_progress);
  EXPECT_TRUE(contains(report.text, "while tasks spin")) << report;
}

TEST(NoProgress, TheLimitOfAnInstantIsInTheEnvironment) {
  setenv("WAITPOINT_INSTANT_LIMIT", "none", 1);
  EXPECT_THROW(Simulation(), BadInput);
  setenv("WAITPOINT_INSTANT_LIMIT", "12", 1);
  EXPECT_EQ(instant_limit_of_environment(7), 12u);
  unsetenv("WAITPOINT_INSTANT_LIMIT");
  EXPECT_EQ(instant_limit_of_environment(7), 7u);
}

TEST(NoProgress, ATimerThatStartsItselfAgainAtOnceIsNamed) {
  const Report report = simulate([] {
    timer* again = nullptr;
    timer restless([&] { again->start_after(0s); }, "restless");
    again = &restless;
    restless.start_after(1ms);
    sleep_for(2ms);
  });
  EXPECT_EQ(report.end, RunEnd::no_progress);
  EXPECT_TRUE(contains(report.text, "timers fire without end, the last one timer #1 \"restless\" of environment"))
      << report;
}

TEST(NoProgress, ALongButFiniteInstantIsNone) {
  in_every_order([] {
    mutex m;
    std::vector<thread> threads;
    threads.reserve(4);
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&] {
        for (int i = 0; i < 5000; ++i) {
          const std::lock_guard guard(m);
        }
      });
    for (thread& t : threads) t.join();
    EXPECT_EQ(now(), Time());
  });
}

TEST(Endless, NamesATaskThatSleepsForEver) {
  const Report report = simulate([] {
    thread sleeper({.name = "beauty"}, [] { sleep_for(std::chrono::hours::max()); });
    sleeper.join();
  });
  EXPECT_EQ(report.end, RunEnd::time_reached);
  EXPECT_TRUE(contains(report.text, "virtual time ran out")) << report;
  EXPECT_TRUE(contains(report.text, "task beauty of environment sleeps without end")) << report;
}

}  // namespace
}  // namespace waitpoint
