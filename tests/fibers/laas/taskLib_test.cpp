// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/taskLib.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>

#include "tests/fibers/laas/laas_run.hpp"

namespace waitpoint::laas {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

int entry(int a, const std::string& b, int* sum) { return *sum += a + static_cast<int>(b.size()); }

TEST(TaskLib, SpawnsTasksWithArgumentsNamesAndPriorities) {
  with_clock([] {
    int sum = 0;
    const long id = taskSpawn("exec", 130, VX_FP_TASK, 20000, entry, 40, "xy", &sum);
    EXPECT_GT(id, 0);
    EXPECT_STREQ(taskName(id), "exec");
    EXPECT_EQ(taskNameToId("exec"), id);
    int priority = 0, options = 0;
    EXPECT_EQ(taskPriorityGet(id, &priority), OK);
    EXPECT_EQ(priority, 130);
    EXPECT_EQ(taskPrioritySet(id, 5), OK);
    taskPriorityGet(id, &priority);
    EXPECT_EQ(priority, 5);
    EXPECT_EQ(taskOptionsGet(id, &options), OK);
    EXPECT_EQ(options, VX_FP_TASK);
    EXPECT_EQ(taskSetUserData(id, 77), OK);
    EXPECT_EQ(taskGetUserData(id), 77u);
    sleep_for(1ms);
    EXPECT_EQ(sum, 42);
    EXPECT_EQ(taskName(id), nullptr);  // it has ended
    EXPECT_EQ(errnoGet(), S_portLib_INVALID_TASKID);
    EXPECT_EQ(taskNameToId("exec"), ERROR);
    EXPECT_EQ(errnoGet(), S_portLib_NO_SUCH_TASK);
  });
}

TEST(TaskLib, MisuseIsAnErrorCode) {
  with_clock([] {
    EXPECT_EQ(taskSpawn("t", 256, 0, 1000, [] {}), ERROR);
    EXPECT_EQ(errnoGet(), EINVAL);
    EXPECT_EQ(taskSpawn("t", -1, 0, 1000, [] {}), ERROR);
    EXPECT_EQ(taskSpawn("t", 1, 0, stack_size_max + 1, [] {}), ERROR);
    EXPECT_EQ(errnoGet(), S_portLib_NO_MEMORY);
    EXPECT_EQ(taskPrioritySet(0, 300), ERROR);
    EXPECT_EQ(taskDelay(-1), ERROR);
    EXPECT_EQ(taskResume(999), ERROR);
    EXPECT_EQ(errnoGet(), S_portLib_INVALID_TASKID);
    EXPECT_EQ(h2initGlob(50), ERROR);  // it runs at 100
    EXPECT_EQ(h2initGlob(100), OK);
    EXPECT_EQ(sysClkRateGet(), 100);
  });
}

TEST(TaskLib, ADelayLastsSoManyTicksFromWhereItBegins) {
  with_clock([] {
    sleep_for(3ms);
    taskDelay(2);
    EXPECT_EQ(now(), Time() + Duration(23ms));
    taskDelay(0);
    EXPECT_EQ(now(), Time() + Duration(23ms));
  });
}

TEST(TaskLib, ResumesATaskThatSuspendedItself) {
  with_clock([] {
    bool went_on = false;
    const long id = taskSpawn(nullptr, 100, 0, 20000, [&] {
      EXPECT_EQ(taskIdSelf(), taskNameToId(taskName(0)));
      EXPECT_EQ(taskSuspend(0), OK);
      EXPECT_EQ(now(), tick(4));
      went_on = true;
    });
    sleep_until_tick(1);
    sleep_until_tick(4);
    taskResume(id);
    sleep_until_tick(5);
    EXPECT_TRUE(went_on);
    EXPECT_EQ(taskSuspend(taskSpawn("other", 1, 0, 1000, [] {})), ERROR);
    EXPECT_EQ(errnoGet(), S_portLib_NOT_IMPLEMENTED);
  });
}

TEST(TaskLib, AServiceKeepsNoRunAlive) {
  const Report report = simulate([] {
    h2initGlob(100);
    taskSpawn("server", 10, TASK_SERVICE, 20000, [] {
      for (;;) taskDelay(1);
    });
    taskDelay(10);
  });
  EXPECT_TRUE(report.passed) << report;
  EXPECT_EQ(report.end_time, tick(10));
}

TEST(TickLib, CountsTicksAndTakesWhatItIsSetTo) {
  with_clock([] {
    EXPECT_EQ(tickGet(), 0u);
    sleep_until_tick(7);
    EXPECT_EQ(tickGet(), 7u);
    sleep_for(Duration(10ms) - Duration::from_ns(1));
    EXPECT_EQ(tickGet(), 7u);
    tickSet(1000);
    sleep_until_tick(10);
    EXPECT_EQ(tickGet(), 1003u);
  });
}

TEST(TickLib, TicksOfAnyRateComeAtMultiplesRoundedOnce) {
  in_every_order([] {
    sleep_for(123ms);
    h2initGlob(75);
    for (std::int64_t k = 1; k < 200; ++k) {
      this_thread::sleep_until(Time() + Duration(123ms) + Period::hertz(75).tick(k) - Duration::from_ns(1));
      ASSERT_EQ(tickGet(), static_cast<unsigned long>(k - 1));
      sleep_for(Duration::from_ns(1));
      ASSERT_EQ(tickGet(), static_cast<unsigned long>(k));
    }
  });
}

}  // namespace
}  // namespace waitpoint::laas
