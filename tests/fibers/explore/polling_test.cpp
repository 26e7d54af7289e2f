// SPDX-License-Identifier: BSD-3-Clause
// Tasks that poll, sleep or spin: their ties are explored, exhaustive strategies claim completeness only for the
// schedules that they tried, and an endless schedule is reported within seconds.
#include <gtest/gtest.h>

#include <functional>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/clock.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

// In the default order the writer, which started first, is first at the instant at which both have slept 12 ms.
void meet_after_many_sleeps() {
  atomic<int> written{0};
  thread writer([&] {
    this_thread::sleep_for(12ms);
    written.store(1);
  });
  thread reader([&] {
    for (int i = 0; i < 12; ++i) this_thread::sleep_for(1ms);
    check(written.load() == 1, "read before it was written");
  });
  writer.join();
  reader.join();
}

TEST(Polling, RepeatedSleepsAreOrderedLikeOtherEvents) {
  EXPECT_TRUE(simulate(meet_after_many_sleeps).passed);
  EXPECT_TRUE(explore(meet_after_many_sleeps, {.strategy = "fifo", .iterations = 1}).passed);
  for (const char* strategy : {"portfolio", "random", "pos", "dfs", "dpor"}) {
    const ExploreReport report = explore(meet_after_many_sleeps, {.strategy = strategy});
    EXPECT_FALSE(report.passed) << strategy << ": " << report;
    EXPECT_EQ(report.schedule.switches.size(), 1U) << strategy;
  }
}

TEST(Polling, ExhaustiveStrategiesSayWhatTheyNeverTried) {
  const auto look_often = [] {
    atomic<int> page{0};
    thread reader([&] {
      for (int i = 0; i < 12; ++i) (void)page.load();
    });
    page.store(1);
    page.store(2);
    reader.join();
  };
  const ExploreReport spun = explore(look_often, {.strategy = "dpor", .iterations = 1'000'000});
  EXPECT_TRUE(spun.passed) << spun;
  EXPECT_FALSE(spun.complete);
  EXPECT_EQ(spun.scope,
            "all schedules up to the order of independent events, if there are no data races, except turns of spinning "
            "tasks");
  // Alone at its instant, until time advances: it could go on loading there.
  const auto look_often_alone = [] {
    atomic<int> page{0};
    thread writer([&] {
      this_thread::sleep_for(1s);
      page.store(1);
    });
    this_thread::sleep_for(500ms);
    for (int i = 0; i < 30; ++i) (void)page.load();
    writer.join();
  };
  for (const auto& [strategy, reach] :
       {std::pair("dfs", ""), {"dpor", " up to the order of independent events, if there are no data races"}})
    EXPECT_EQ(explore(look_often_alone, {.strategy = strategy, .iterations = 1'000'000}).scope,
              std::string("all schedules") + reach + ", except turns of spinning tasks");
  const auto compute_something = [] {
    thread other([] { compute(1ms, 3ms); });
    other.join();
  };
  const ExploreReport timed = explore(compute_something, {.strategy = "dfs"});
  EXPECT_FALSE(timed.complete);
  EXPECT_EQ(timed.scope, "all schedules, except computing costs between the bounds");
  const auto take_in_turn = [] {
    mutex m;
    thread other([&] { const std::lock_guard guard(m); });
    { const std::lock_guard guard(m); }
    other.join();
  };
  const ExploreReport bounded = explore(take_in_turn, {.strategy = "bounded:2"});
  EXPECT_FALSE(bounded.complete);
  EXPECT_EQ(bounded.scope, "all schedules with at most 2 preemptions");
  EXPECT_TRUE(explore(take_in_turn, {.strategy = "dfs"}).complete);
}

// A loop that polls a number of times and then does something else, as those of semaphores do before they sleep.
TEST(Polling, TaskThatStopsPollingRunsBeforeOthersAtTheInstant) {
  for (const bool yields : {false, true}) {
    const auto give_up = [yields] {
      atomic<bool> given{false};
      thread taker([&] {
        for (int i = 0; i < 16 && !given.load(); ++i)
          if (yields) this_thread::yield();
        check(given.load(), "gave up");
      });
      given.store(true);
      taker.join();
    };
    for (const char* strategy : {"portfolio", "random", "pct"}) {
      const ExploreReport report = explore(give_up, {.strategy = strategy});
      EXPECT_NE(report.text.find("gave up"), std::string::npos) << strategy << ": " << report;
    }
    EXPECT_TRUE(explore(give_up, {.strategy = "bounded:2"}).passed);
  }
}

TEST(Polling, EndlessSchedulesAreReportedInSeconds) {
  const ExploreReport sleeping = explore([] {
    for (;;) this_thread::sleep_for(100ms);
  });
  EXPECT_NE(sleeping.text.find("not finished at 3600.000000000 s"), std::string::npos) << sleeping;
  const ExploreReport spinning = explore([] {
    atomic<bool> mine{false}, yours{false};
    thread other([&] {
      while (!mine.load()) this_thread::yield();
      yours.store(true);
    });
    while (!yours.load()) this_thread::yield();
    mine.store(true);
    other.join();
  });
  EXPECT_NE(spinning.text.find("no progress"), std::string::npos) << spinning;
}

// Each loop waits for a later action of another task: when only loops are left at an instant, time advances.
TEST(Polling, LoopsThatWaitForATaskThatSleepsOrComputesEnd) {
  const std::function<void(atomic<bool>&, mutex&)> loops[] = {
      [](atomic<bool>& done, mutex&) {
        while (!done.load()) this_thread::yield();
      },
      [](atomic<bool>& done, mutex&) {
        while (!done.load()) {
        }
      },
      [](atomic<bool>&, mutex& held) {
        while (!held.try_lock()) this_thread::yield();
        held.unlock();
      },
      [](atomic<bool>&, mutex&) {
        const auto begun = steady_clock::now();
        while (steady_clock::now() - begun < 1ms) {
        }
      },
  };
  for (const auto& wait : loops)
    for (const bool computes : {false, true})
      for (const char* strategy : {"portfolio", "random", "fifo"}) {
        const ExploreReport report = explore(
            [&] {
              atomic<bool> done{false};
              mutex held;
              held.lock();
              thread one([&] { wait(done, held); }), other([&] { wait(done, held); });
              if (computes)
                compute(5ms);
              else
                this_thread::sleep_for(5ms);
              done.store(true);
              held.unlock();
              one.join();
              other.join();
            },
            {.strategy = strategy, .iterations = 30});
        EXPECT_TRUE(report.passed) << report;
      }
}

TEST(Polling, DporKnowsThatAYieldLetsOthersIn) {
  for (const int missed : {3, 4}) {
    const auto add_twice_each = [missed] {
      atomic<int> sum{0};
      const auto add = [&] {
        for (int i = 0; i < 2; ++i) {
          const int seen = sum.load();
          this_thread::yield();
          sum.store(seen + 1);
        }
      };
      thread one(add), other(add);
      one.join();
      other.join();
      check(sum.load() != missed, "that sum");
    };
    for (const char* strategy : {"bounded:3", "dpor"})
      EXPECT_FALSE(explore(add_twice_each, {.strategy = strategy, .iterations = 100'000}).passed)
          << strategy << " " << missed;
  }
}

// A release that began before the end of the run continues after it, up to the next call that waits.
TEST(Polling, AFailureWhileAnotherTaskIsOnItsWayToAJoinIsReported) {
  const ExploreReport report = explore([] {
    atomic<bool> there{false};
    thread other([&] { check(there.load(), "not there"); });
    there.store(true);
    other.join();
  });
  EXPECT_NE(report.text.find("not there"), std::string::npos) << report;
  EXPECT_FALSE(simulate([] {
                 atomic<bool> there{false};
                 thread other([&] { check(false, "never there"); });
                 there.store(true);
                 other.join();
               }).passed);
}

}  // namespace
}  // namespace waitpoint
