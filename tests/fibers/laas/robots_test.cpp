// SPDX-License-Identifier: BSD-3-Clause
// Each robot has its own h2 name space and clock, which are new in each run.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fibers/laas/h2evnLib.hpp"
#include "fibers/laas/h2semLib.hpp"
#include "fibers/laas/h2timerLib.hpp"
#include "fibers/laas/semLib.hpp"
#include "fibers/laas/taskLib.hpp"
#include "fibers/laas/wdLib.hpp"
#include "tests/fibers/laas/laas_run.hpp"

namespace waitpoint::laas {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

// A robot in the style of GenoM: a periodic task, one that waits for events, watchdogs, a mutex with timeouts.
void robot(int rate) {
  h2initGlob(rate);
  const SEM_ID data = semMCreate(SEM_Q_PRIORITY);
  const long control = taskSpawn("control", 10, TASK_SERVICE, 20000, [data] {
    for (;;) {
      if (h2evnSusp(7) == FALSE) continue;
      if (semTake(data, 2) != OK) continue;
      sleep_for(3ms);
      semGive(data);
    }
  });
  for (int i = 0; i < 3; ++i)
    taskSpawn("exec", 100 + i, 0, 20000, [data, control, i] {
      const H2TIMER_ID timer = h2timerAlloc();
      h2timerStart(timer, 2 + i, i);
      for (int k = 0; k < 20; ++k) {
        h2timerPause(timer);
        semTake(data, WAIT_FOREVER);
        compute(std::chrono::milliseconds(i));
        semGive(data);
        h2evnSignal(control);
        taskDelay(0);
      }
      h2timerFree(timer);
    });
  const WDOG_ID dog = wdCreate();
  const long self = taskIdSelf();
  h2evnSusp(1);
  wdStart(
      dog, 9, [self](long) { h2evnSignal(self); }, 0);
  h2evnSusp(0);
  wdDelete(dog);
}

TEST(LaasRobots, DigestsRepeatInEveryOrder) {
  const auto digest = [](std::uint64_t number) {
    const Report report = simulate([] { robot(100); }, order_number(number));
    EXPECT_TRUE(report.passed) << report;
    return report.digest.value();
  };
  std::vector<std::uint64_t> digests;
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    digests.push_back(digest(number));
    for (int repeat = 0; repeat < 3; ++repeat) ASSERT_EQ(digest(number), digests.back()) << number;
  }
  EXPECT_NE(digests[1], digests[2]);
}

TEST(LaasRobots, ARobotsDigestIsTheSameBesideAnother) {
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    const auto digest_of_dala = [&](bool with_other) {
      Simulation simulation(order_number(number));
      kernel::Robot& dala = simulation.add_robot("dala");
      if (with_other) simulation.spawn(simulation.add_robot("rackham"), {}, [] { robot(250); });
      simulation.spawn(dala, {}, [] { robot(100); });
      EXPECT_EQ(simulation.run_before(), RunEnd::ended);
      return dala.digest.value();
    };
    ASSERT_EQ(digest_of_dala(false), digest_of_dala(true)) << number;
  }
}

TEST(LaasRobots, ShareNeitherClocksNorNumbersNorNames) {
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    Simulation simulation(order_number(number));
    int checked = 0;
    for (const char* name : {"dala", "rackham"})
      simulation.spawn(simulation.add_robot(name), {}, [&checked, name] {
        const bool is_dala = name[0] == 'd';
        const int rate = is_dala ? 100 : 1000;
        if (!is_dala) sleep_for(500ms);
        EXPECT_EQ(h2initGlob(rate), OK);
        const H2SEM_ID sem = h2semAlloc(H2SEM_SYNC);
        EXPECT_EQ(sem, 1);
        const long id = taskSpawn("exec", 1, 0, 1000, [] { taskSuspend(0); });
        EXPECT_EQ(id, 1);
        std::vector<H2TIMER_ID> timers;
        for (int i = 0; i < NMAX_TIMERS; ++i) EXPECT_NE(h2timerAlloc(), nullptr);
        sleep_for(1s);
        EXPECT_EQ(tickGet(), static_cast<unsigned long>(rate));
        tickSet(0);
        EXPECT_EQ(h2semGive(sem), OK);
        EXPECT_EQ(taskNameToId("exec"), id);
        taskResume(id);
        sleep_for(1s);
        EXPECT_EQ(tickGet(), static_cast<unsigned long>(rate));
        EXPECT_EQ(h2semTake(sem, 1), TRUE);
        EXPECT_EQ(h2semTake(sem, 1), FALSE);
        ++checked;
      });
    ASSERT_EQ(simulation.run_before(), RunEnd::ended) << simulation.trouble();
    ASSERT_EQ(checked, 2);
  }
}

// A run that ends with tasks in every kind of wait.
TEST(LaasRobots, ARunLeftInTheMiddleIsUnwound) {
  for (int ms = 0; ms < 200; ms += 13) {
    Simulation simulation;
    simulation.spawn(simulation.add_robot("dala"), {}, [] { robot(100); });
    simulation.run_before(Time() + Duration(std::chrono::milliseconds(ms)));
    simulation.unwind();
    EXPECT_TRUE(simulation.abandoned().empty());
  }
}

}  // namespace
}  // namespace waitpoint::laas
