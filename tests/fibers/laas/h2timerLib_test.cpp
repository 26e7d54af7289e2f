// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/h2timerLib.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "core/random.hpp"
#include "fibers/laas/taskLib.hpp"
#include "tests/fibers/laas/laas_run.hpp"

namespace waitpoint::laas {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(H2Timer, StartsWhereTheTickModuloTwentyIsItsDelayWheneverItIsStarted) {
  with_clock([] {
    const H2TIMER_ID timer = h2timerAlloc();
    const std::pair<int, int> starts_and_firsts[] = {{0, 5}, {6, 25}, {37, 45}, {64, 65}, {65, 85}, {106, 125}};
    for (const auto& [start, first] : starts_and_firsts) {
      sleep_until_tick(start);
      ASSERT_EQ(h2timerStart(timer, 40, 5), OK);
      ASSERT_EQ(h2timerPause(timer), OK);
      ASSERT_EQ(now(), tick(first));
      ASSERT_EQ(h2timerStop(timer), OK);
    }
  });
}

TEST(H2Timer, TasksOfOneDelayRunTogetherAndOfOthersApart) {
  with_clock([] {
    std::vector<std::vector<Time>> woken(3);
    std::vector<thread> threads;
    for (std::size_t i = 0; i < 3; ++i)
      threads.emplace_back([&woken, i] {
        sleep_for(std::chrono::milliseconds(7 * i + 3));
        const H2TIMER_ID timer = h2timerAlloc();
        h2timerStart(timer, 10, i < 2 ? 4 : 9);
        for (int k = 0; k < 20; ++k) {
          h2timerPause(timer);
          woken[i].push_back(now());
        }
        h2timerFree(timer);
      });
    for (thread& t : threads) t.join();
    EXPECT_EQ(woken[0], woken[1]);
    for (int k = 0; k < 20; ++k) {
      EXPECT_EQ(woken[0][static_cast<std::size_t>(k)], tick(4 + 10 * k));
      EXPECT_EQ(woken[2][static_cast<std::size_t>(k)], tick(9 + 10 * k));
    }
  });
}

TEST(H2Timer, MissedPeriodsCoalesceIntoOne) {
  with_clock([] {
    const H2TIMER_ID timer = h2timerAlloc();
    h2timerStart(timer, 5, 0);
    h2timerPause(timer);
    EXPECT_EQ(now(), tick(20));
    sleep_until_tick(42);  // 25, 30, 35 and 40 are missed
    h2timerPause(timer);
    EXPECT_EQ(now(), tick(42));  // all of them at once
    h2timerPause(timer);
    EXPECT_EQ(now(), tick(45));
  });
}

TEST(H2Timer, PauseResetTakesOneAndBeginsANewPeriodThere) {
  with_clock([] {
    const H2TIMER_ID timer = h2timerAlloc();
    h2timerStart(timer, 5, 0);
    h2timerPauseReset(timer);
    EXPECT_EQ(now(), tick(20));
    sleep_until_tick(32);  // 25 and 30 are missed
    h2timerPauseReset(timer);
    h2timerPauseReset(timer);
    EXPECT_EQ(now(), tick(32));
    h2timerPause(timer);
    EXPECT_EQ(now(), tick(37));
  });
}

TEST(H2Timer, ChangesItsPeriodStopsAndStartsAgain) {
  with_clock([] {
    const H2TIMER_ID timer = h2timerAlloc();
    EXPECT_EQ(h2timerChangePeriod(timer, 3), ERROR);
    EXPECT_EQ(errnoGet(), S_h2timerLib_STOPPED_TIMER);
    h2timerStart(timer, 10, 1);
    h2timerPause(timer);
    sleep_until_tick(8);  // 7 of 10 have passed: 3 of 4
    h2timerChangePeriod(timer, 4);
    h2timerPause(timer);
    EXPECT_EQ(now(), tick(9));
    sleep_until_tick(14);
    h2timerStop(timer);  // the tick at 13 stays pending
    EXPECT_EQ(h2timerPause(timer), OK);
    EXPECT_EQ(now(), tick(14));
    thread other([&] {
      sleep_until_tick(33);
      h2timerStart(timer, 10, 0);
    });
    h2timerPause(timer);  // stopped: until it is started again
    EXPECT_EQ(now(), tick(40));
    other.join();
  });
}

TEST(H2Timer, ThereAreTwentyAndMisuseIsAnErrorCode) {
  with_clock([] {
    std::vector<H2TIMER_ID> all;
    for (int i = 0; i < NMAX_TIMERS; ++i) all.push_back(h2timerAlloc());
    EXPECT_NE(all.back(), nullptr);
    EXPECT_EQ(h2timerAlloc(), nullptr);
    EXPECT_EQ(errnoGet(), S_h2timerLib_TOO_MUCH_TIMERS);
    EXPECT_EQ(h2timerStart(all[0], 0, 0), ERROR);
    EXPECT_EQ(errnoGet(), S_h2timerLib_BAD_PERIOD);
    for (const int delay : {-1, 20}) {
      EXPECT_EQ(h2timerStart(all[0], 1, delay), ERROR);
      EXPECT_EQ(errnoGet(), S_h2timerLib_BAD_DELAY);
    }
    EXPECT_EQ(h2timerStart(all[0], 7, 19), OK);  // neither a multiple nor a divisor of 20
    EXPECT_EQ(h2timerStart(all[0], 7, 19), ERROR);
    EXPECT_EQ(errnoGet(), S_h2timerLib_NOT_STOPPED_TIMER);
    thread waiter([&] {
      EXPECT_EQ(h2timerPause(all[1]), ERROR);
      EXPECT_EQ(errnoGet(), S_h2timerLib_TIMER_NOT_INIT);
    });
    sleep_for(1ms);
    EXPECT_EQ(h2timerFree(all[1]), OK);
    waiter.join();
    EXPECT_EQ(h2timerPause(all[1]), ERROR);
    EXPECT_EQ(h2timerFree(nullptr), ERROR);
    EXPECT_NE(h2timerAlloc(), nullptr);
  });
  in_every_order([] {
    h2initGlob(0);  // no clock
    EXPECT_EQ(h2timerAlloc(), nullptr);
    EXPECT_EQ(errnoGet(), S_h2timerLib_TIMER_NOT_INIT);
  });
}

// The interrupt of pocolibs, to the letter: it is called at each tick and checks the timer.
struct WalkedTimer {
  void at_tick() {
    ++count_of_ticks;
    if (state == 2) {
      if (++count == period) fire();
    } else if (state == 1 && count_of_ticks % 20 == delay) {
      state = 2;
      fire();
    }
  }
  void fire() {
    count = 0;
    ++given;
  }
  std::int64_t count_of_ticks = 0;
  int state = 0, period = 1, delay = 0, count = 0, given = 0;
};

TEST(H2Timer, BehavesAsIfEachTickWereWalked) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Report report = simulate([seed] {
      const RandomStream random(seed, "", "h2timer");
      h2initGlob(100);
      const H2TIMER_ID timer = h2timerAlloc();
      WalkedTimer walked;
      const auto walk_to = [&](std::int64_t k) {
        while (walked.count_of_ticks < k) walked.at_tick();
      };
      for (std::uint64_t i = 0; i < 60; ++i) {
        const int argument = 1 + static_cast<int>(random.below(30, 3 * i));
        switch (random.below(7, 3 * i + 1)) {
          case 0:
          case 1: {
            const bool starts = walked.state == 0;
            ASSERT_EQ(h2timerStart(timer, argument, argument % 20), starts ? OK : ERROR);
            if (!starts) break;
            walked.state = 1;
            walked.period = argument;
            walked.delay = argument % 20;
            walked.count = walked.given = 0;
            break;
          }
          case 2:
          case 3:
            if (walked.state == 0 && walked.given == 0) break;  // would never return
            while (walked.given == 0) walked.at_tick();
            walked.given = 0;
            ASSERT_EQ(h2timerPause(timer), OK);
            break;
          case 4:
            if (walked.state == 0 && walked.given == 0) break;
            while (walked.given == 0) walked.at_tick();
            --walked.given;
            walked.count = 0;
            ASSERT_EQ(h2timerPauseReset(timer), OK);
            break;
          case 5:
            ASSERT_EQ(h2timerChangePeriod(timer, argument), walked.state == 0 ? ERROR : OK);
            if (walked.state == 0) break;
            walked.period = argument;
            walked.count %= argument;
            break;
          default:
            if (random.below(3, 3 * i + 2) != 0) break;
            ASSERT_EQ(h2timerStop(timer), OK);
            walked.state = 0;
        }
        ASSERT_EQ(tickGet(), static_cast<unsigned long>(walked.count_of_ticks)) << "seed " << seed << " step " << i;
        taskDelay(static_cast<int>(random.below(25, 3 * i + 2)));
        walk_to(static_cast<std::int64_t>(tickGet()));
      }
    });
    ASSERT_TRUE(report.passed) << report;
    ASSERT_FALSE(HasFailure());
  }
}

}  // namespace
}  // namespace waitpoint::laas
