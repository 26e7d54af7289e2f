// SPDX-License-Identifier: BSD-3-Clause
// The failures that explore() finds, and its report.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/explore/faulty_bodies.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

using faulty::count_to_three;
using faulty::lose_a_wake_up;
using namespace std::chrono_literals;

TEST(Explore, PassesIfEverySchedulePasses) {
  const ExploreReport report = explore([] { count_to_three(1); });
  EXPECT_TRUE(report.passed) << report;
  EXPECT_EQ(report.distinct,
            36U);  // of three stores in any order; the first one's load has one place, the others 2 and 3
  EXPECT_TRUE(report.complete);
  EXPECT_TRUE(simulate(lose_a_wake_up).passed);  // the default order passes
}

TEST(Explore, ALostWakeUpIsFoundMinimizedAndExplained) {
  const ExploreReport report = explore(lose_a_wake_up);
  EXPECT_FALSE(report.passed);
  EXPECT_TRUE(contains(report.text, "deadlock at ")) << report;
  EXPECT_TRUE(contains(report.text, "task consumer of environment waits (wait) for condition variable")) << report;
  EXPECT_EQ(report.schedule.switches.size(), 1U) << report;
  EXPECT_TRUE(contains(report.text, "1 switch away from the default order fails")) << report;
  EXPECT_TRUE(contains(report.text, "the last choice from which it could still have passed")) << report;
  EXPECT_TRUE(contains(report.text, "producer#2, about to ")) << report;
  EXPECT_TRUE(contains(report.text, "consumer#1  wait condition variable")) << report;
  EXPECT_TRUE(contains(report.text, "replay: WAITPOINT_REPLAY=wx1.")) << report;
  EXPECT_TRUE(contains(report.text, "--gtest_filter=Explore.ALostWakeUpIsFoundMinimizedAndExplained")) << report;
  EXPECT_LE(report.replay.size(), 80U);
}

// Running other tasks while one polls is the default order, not a switch away from it.
TEST(Explore, PollingAddsNoSwitchesToAFailure) {
  const ExploreReport report = explore([] {
    atomic<int> written{0}, done{0};
    thread polling([&] {
      while (done.load() < 2) this_thread::yield();
    });
    const auto increment = [&] {
      const int read = written.load();
      written.store(read + 1);
      done.fetch_add(1);
    };
    thread first(increment), second(increment);
    for (thread* each : {&polling, &first, &second}) each->join();
    check(written.load() == 2, "a lost update");
  });
  EXPECT_FALSE(report.passed);
  EXPECT_EQ(report.schedule.switches.size(), 1U) << report;
}

TEST(Explore, EveryWayToFailIsReportedInItsWords) {
  const auto words = [](std::function<void()> body) { return explore(std::move(body)).text; };
  EXPECT_TRUE(contains(words([] { count_to_three(3); }), ": an increment was lost"));
  const auto throws = [] {
    atomic<int> turn{0};
    thread([&] { turn.store(1); }).detach();
    if (turn.load() == 1) throw std::runtime_error("too early");
    this_thread::sleep_for(1ms);
  };
  EXPECT_TRUE(
      contains(words(throws), "an exception escaped from task main of environment at 0.000000000 s: too early"));
  const auto locks_in_opposite_orders = [] {
    mutex left, right;
    const auto take = [](mutex& first, mutex& second) {
      const std::lock_guard a(first);
      const std::lock_guard b(second);
    };
    thread one([&] { take(left, right); });
    thread two([&] { take(right, left); });
    one.join();
    two.join();
  };
  EXPECT_TRUE(contains(words(locks_in_opposite_orders), "wait for each other"));
  const auto spins = [] {
    atomic<bool> never{false};
    while (!never.load()) {
    }
  };
  EXPECT_TRUE(contains(words(spins), "no progress"));
}

TEST(Explore, WithinDeclaredTimesOnlyFeasibleSchedulesAreTried) {
  const auto body = [](Duration slowest) {
    atomic<bool> written{false};
    thread writer([&] {
      compute(Duration(1ms), slowest);
      written.store(true);
    });
    thread reader([&] {
      compute(3ms, 4ms);
      check(written.load(), "read before it was written");
    });
    writer.join();
    reader.join();
  };
  EXPECT_TRUE(explore([&] { body(Duration(2ms)); }).passed);
  const ExploreReport wider = explore([&] { body(Duration(3500us)); }, {.iterations = 1000});
  EXPECT_TRUE(contains(wider.text, "read before it was written")) << wider;
}

}  // namespace
}  // namespace waitpoint
