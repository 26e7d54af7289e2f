// SPDX-License-Identifier: BSD-3-Clause
// Choices other than the order of tasks: waiters, spurious wake-ups, timeouts, costs.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/condition_variable_any.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

TEST(Explore, ReportsWakeUpsTimeoutsAndDurationsInWords) {
  const ExploreReport slow = explore([] {
    thread worker({.name = "worker"}, [] {
      compute(1ms, 3ms);
      check(now() >= Time() + 2ms, "too early");
    });
    worker.join();
  });
  EXPECT_TRUE(contains(slow.text, ", at 0.000000000 s: worker#1 computes ")) << slow;
  EXPECT_TRUE(contains(slow.text, "; it passes if it computes 3 ms")) << slow;
  const ExploreReport woken = explore([] {
    mutex m;
    condition_variable arrived;
    bool there = false;
    thread waiter({.name = "waiter"}, [&] {
      std::unique_lock lock(m);
      if (!there) arrived.wait(lock);
      check(there, "woken for nothing");
    });
    this_thread::sleep_for(1ms);
    {
      const std::lock_guard guard(m);
      there = true;
      arrived.notify_one();
    }
    waiter.join();
  });
  EXPECT_TRUE(contains(woken.text, "waiter#1 (wait condition variable #2) wakes up spuriously")) << woken;
}

TEST(Explore, ChoosesWakeUpsTimeoutsAndDurations) {
  // The waiter to wake; a spurious wake-up; a timeout or a wake-up at one instant; a computing time.
  const auto can_fail = [](std::function<void()> body) { return !explore(std::move(body)).passed; };
  EXPECT_TRUE(can_fail([] {
    mutex m;
    condition_variable c;
    int woken = 0;
    const auto wait = [&](int name) {
      std::unique_lock lock(m);
      c.wait(lock);
      if (woken == 0) woken = name;
    };
    thread a([&] { wait(1); });
    this_thread::sleep_for(1ms);
    thread b([&] { wait(2); });
    this_thread::sleep_for(1ms);
    c.notify_one();
    this_thread::sleep_for(1ms);
    c.notify_one();
    a.join();
    b.join();
    check(woken == 1, "the second waiter was served first");
  }));
  const auto trust_a_wake_up = [](auto& c) {
    mutex m;
    bool notified = false;
    thread notifier([&] {
      this_thread::sleep_for(1ms);
      const std::lock_guard guard(m);
      notified = true;
      c.notify_one();
    });
    {
      std::unique_lock lock(m);
      c.wait(lock);
    }
    check(notified, "woken for nothing");
    notifier.join();
  };
  EXPECT_TRUE(can_fail([&] {
    condition_variable c;
    trust_a_wake_up(c);
  }));
  EXPECT_TRUE(can_fail([&] {
    condition_variable_any c;
    trust_a_wake_up(c);
  }));
  for (const bool in_time : {true, false})
    EXPECT_TRUE(can_fail([&] {
      binary_semaphore done(0);
      thread worker([&] {
        this_thread::sleep_for(5ms);
        done.release();
      });
      const bool got = done.try_acquire_for(5ms);
      worker.join();
      check(got != in_time);
    }));
  for (const int cost_ms : {1, 2, 3})
    EXPECT_TRUE(can_fail([&] {
      compute(1ms, 3ms);
      check(now() != Time() + Duration(std::chrono::milliseconds(cost_ms)));
    }));
}

}  // namespace
}  // namespace waitpoint
