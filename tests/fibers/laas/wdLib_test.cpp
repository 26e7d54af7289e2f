// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/wdLib.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>
#include <vector>

#include "fibers/laas/h2evnLib.hpp"
#include "fibers/laas/h2timerLib.hpp"
#include "fibers/laas/semLib.hpp"
#include "fibers/laas/taskLib.hpp"
#include "tests/fibers/laas/laas_run.hpp"

namespace waitpoint::laas {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(WdLib, FiresOnceAtItsTick) {
  with_clock([] {
    std::vector<unsigned long> fired;
    const WDOG_ID dog = wdCreate();
    sleep_for(7ms);
    EXPECT_EQ(wdStart(
                  dog, 3,
                  [&](long parameter) {
                    EXPECT_EQ(parameter, 42);
                    fired.push_back(tickGet());
                  },
                  42),
              OK);
    sleep_for(1s);
    EXPECT_EQ(fired, std::vector{3ul});
  });
}

TEST(WdLib, AtOneTickTheLatestCreatedIsFirstAndH2TimersComeLast) {
  with_clock([] {
    std::string order;
    const WDOG_ID a = wdCreate(), b = wdCreate(), c = wdCreate();
    const H2TIMER_ID timer = h2timerAlloc();
    h2timerStart(timer, 20, 5);
    thread waiter([&] {
      h2timerPause(timer);
      order += 't';
    });
    sleep_for(1ms);
    // Independent of the order of the starts.
    wdStart(
        b, 5, [&](long) { order += 'b'; }, 0);
    wdStart(
        c, 5, [&](long) { order += 'c'; }, 0);
    wdStart(
        a, 5, [&](long) { order += 'a'; }, 0);
    sleep_until_tick(5);
    waiter.join();
    EXPECT_EQ(order, "cbat");
    // A deleted and recreated one is the latest.
    wdDelete(a);
    const WDOG_ID again = wdCreate();
    wdStart(
        b, 5, [&](long) { order += 'b'; }, 0);
    wdStart(
        again, 5, [&](long) { order += 'a'; }, 0);
    sleep_until_tick(10);
    EXPECT_EQ(order, "cbatab");
  });
}

TEST(WdLib, StartedAgainCancelledOrDeletedItDoesNotFireAsBefore) {
  with_clock([] {
    std::vector<std::string> fired;
    const auto note = [&](const char* name) {
      return [&fired, name](long) { fired.push_back(name + std::to_string(tickGet())); };
    };
    const WDOG_ID a = wdCreate(), b = wdCreate(), c = wdCreate();
    wdStart(a, 3, note("a"), 0);
    wdStart(b, 3, note("b"), 0);
    wdStart(c, 3, note("c"), 0);
    sleep_until_tick(2);
    wdStart(a, 3, note("a"), 0);
    EXPECT_EQ(wdCancel(b), OK);
    EXPECT_EQ(wdDelete(c), OK);
    sleep_until_tick(20);
    EXPECT_EQ(fired, std::vector<std::string>{"a5"});
    EXPECT_EQ(wdCancel(c), ERROR);
    EXPECT_EQ(errnoGet(), S_wdLib_ID_ERROR);
    EXPECT_EQ(wdStart(nullptr, 1, note("x"), 0), ERROR);
    EXPECT_EQ(wdStart(a, 0, note("x"), 0), ERROR);
    EXPECT_EQ(errnoGet(), EINVAL);
  });
}

TEST(WdLib, ARoutineGivesSignalsRestartsAndCancels) {
  with_clock([] {
    const SEM_ID sem = semBCreate(0, SEM_EMPTY);
    const WDOG_ID beat = wdCreate(), victim = wdCreate(), killer = wdCreate();
    const long self = taskIdSelf();
    EXPECT_EQ(h2evnSusp(1), FALSE);  // registers it for events
    sleep_until_tick(3);
    std::function<void(long)> again = [&](long left) {
      semGive(sem);
      h2evnSignal(self);
      if (left > 1) wdStart(beat, 2, again, left - 1);
    };
    bool fired = false;
    wdStart(beat, 2, again, 3);
    wdStart(
        victim, 4, [&](long) { fired = true; }, 0);
    wdStart(
        killer, 4, [&](long) { wdCancel(victim); }, 0);  // created later, so called before
    for (int i = 1; i <= 3; ++i) {
      EXPECT_EQ(semTake(sem, WAIT_FOREVER), OK);
      EXPECT_EQ(now(), tick(3 + 2 * i));
      EXPECT_EQ(h2evnSusp(0), TRUE);
    }
    EXPECT_EQ(semTake(sem, 10), ERROR);
    EXPECT_FALSE(fired);
  });
}

// An unused clock of a robot costs nothing, at any rate.
TEST(WdLib, TicksAtWhichNothingIsDueCostNoEvents) {
  const auto events = [](int rate) {
    return simulate([rate] {
             h2initGlob(rate);
             const H2TIMER_ID timer = h2timerAlloc();
             h2timerStart(timer, 1, 0);  // fires at each tick; no task waits
             wdStart(
                 wdCreate(), rate * 3600, [](long) {}, 0);
             sleep_for(1h);
             EXPECT_EQ(h2timerPause(timer), OK);  // at once: it did fire
             EXPECT_EQ(tickGet(), static_cast<unsigned long>(rate) * 3600);
           })
        .events;
  };
  EXPECT_EQ(events(100), events(10000));
  EXPECT_LT(events(10000), 20u);
}

TEST(WdLib, AClockKeepsNoRunAlive) {
  const Report report = simulate([] {
    h2initGlob(100);
    const WDOG_ID beat = wdCreate();
    static std::function<void(long)> again;
    again = [beat](long) { wdStart(beat, 1, again, 0); };
    wdStart(beat, 1, again, 0);
    sleep_for(50ms);
  });
  EXPECT_TRUE(report.passed) << report;
  EXPECT_EQ(report.end_time, tick(5));
}

TEST(WdLibDeathTest, ARoutineThatWaitsIsABug) {
  EXPECT_DEATH(simulate([] {
                 h2initGlob(100);
                 wdStart(
                     wdCreate(), 1, [](long) { semTake(semBCreate(0, SEM_EMPTY), WAIT_FOREVER); }, 0);
                 sleep_for(1s);
               }),
               "a timer's callback waits");
}

}  // namespace
}  // namespace waitpoint::laas
