// SPDX-License-Identifier: BSD-3-Clause
// Tasks, semaphores, timers, watchdogs and dates by the functions of C: their behaviour is tested by those of C++.
#include "fibers/laas/include/taskLib.h"

#include <cerrno>
#include <cstdint>

#include "fibers/laas/include/h2evnLib.h"
#include "fibers/laas/include/h2semLib.h"
#include "fibers/laas/include/h2timeLib.h"
#include "fibers/laas/include/h2timerLib.h"
#include "fibers/laas/include/semLib.h"
#include "fibers/laas/include/wdLib.h"
#include "tests/fibers/laas/pocolibs/pocolibs_run.hpp"

namespace waitpoint {
namespace {

TEST(TaskLibInC, ATaskRunsItsFunction) {
  with_clock([] {
    int runs = 0;
    const auto count = [](void* runs_address) -> void* {
      ++*static_cast<int*>(runs_address);
      EXPECT_STREQ(taskName(0), "tCount");
      return nullptr;
    };
    const long id = taskSpawn2("tCount", 100, VX_FP_TASK, 20000, count, &runs);
    EXPECT_EQ(taskNameToId("tCount"), id);
    int priority = 0, options = 0;
    EXPECT_EQ(taskPriorityGet(id, &priority), OK);
    EXPECT_EQ(priority, 100);
    EXPECT_EQ(taskOptionsSet(id, 3, 1), OK);
    EXPECT_EQ(taskOptionsGet(id, &options), OK);
    EXPECT_EQ(options, VX_FP_TASK | 1);
    EXPECT_EQ(taskSetUserData(id, 7), OK);
    EXPECT_EQ(taskGetUserData(id), 7u);
    EXPECT_NE(taskTcb(id), taskTcb(0));
    taskDelay(1);
    EXPECT_EQ(runs, 1);
    EXPECT_EQ(taskSpawn2("tLarge", 100, 0, 1 << 20, count, nullptr), ERROR);
    EXPECT_EQ(error_name(), "S_portLib_NO_MEMORY");
    EXPECT_EQ(taskLock(), ERROR);
    EXPECT_EQ(taskUnlock(), ERROR);
  });
}

TEST(TaskLibInC, TasksEndWithTheFirstTask) {
  for (const int ticks : {1, 1000}) {
    const Report report = in_order([ticks] {
      h2initGlob(100);
      taskSpawn2(
          "tForever", 100, 0, 20000,
          [](void*) -> void* {
            for (;;) taskDelay(1);
          },
          nullptr);
      taskDelay(ticks);
    });
    EXPECT_EQ(report.end_time, Time() + Duration(std::chrono::milliseconds(10)) * ticks);
  }
}

TEST(TaskLibInC, ATaskDeletesItself) {
  with_clock([] {
    int steps = 0;
    const long id = taskSpawn2(
        nullptr, 100, 0, 20000,
        [](void* steps_address) -> void* {
          ++*static_cast<int*>(steps_address);
          taskDelete(0);
          ++*static_cast<int*>(steps_address);
          return nullptr;
        },
        &steps);
    EXPECT_EQ(taskDelete(id), ERROR);
    EXPECT_EQ(error_name(), "S_portLib_NOT_IMPLEMENTED");
    taskDelay(1);
    EXPECT_EQ(steps, 1);
    EXPECT_EQ(taskName(id), nullptr);
    EXPECT_EQ(taskDelete(id), ERROR);
    EXPECT_EQ(error_name(), "S_portLib_INVALID_TASKID");
    EXPECT_EQ(taskDelete(0), ERROR);  // not made by taskSpawn
  });
}

TEST(TaskLibInC, AThreadGetsATasksName) {
  with_clock([] {
    const long id = taskFromThread("tMine");
    EXPECT_EQ(id, taskIdSelf());
    EXPECT_EQ(taskNameToId("tMine"), id);
  });
}

TEST(TaskLibInC, ASuspendedTaskIsResumed) {
  with_clock([] {
    const long id = taskSpawn2(
        "tSleeper", 100, 0, 20000,
        [](void*) -> void* {
          taskSuspend(0);
          taskDelay(3);
          return nullptr;
        },
        nullptr);
    taskDelay(1);
    EXPECT_EQ(taskResume(id), OK);
    taskDelay(1);
    EXPECT_EQ(taskPrioritySet(id, 20), OK);
    taskDelay(5);
    EXPECT_EQ(taskResume(id), ERROR);
  });
}

TEST(SemLibInC, SemaphoresCountLockAndTimeOut) {
  with_clock([] {
    const SEM_ID binary = semBCreate(SEM_Q_FIFO, SEM_FULL), counting = semCCreate(SEM_Q_FIFO, 2);
    const SEM_ID mutex = semMCreate(SEM_Q_PRIORITY);
    EXPECT_EQ(semTake(binary, NO_WAIT), OK);
    EXPECT_EQ(semTake(binary, 2), ERROR);
    EXPECT_EQ(error_name(), "S_semLib_TIMEOUT");
    EXPECT_EQ(tickGet(), 3u);
    EXPECT_EQ(semTake(counting, NO_WAIT), OK);
    EXPECT_EQ(semTake(counting, NO_WAIT), OK);
    EXPECT_EQ(semFlush(counting), OK);
    EXPECT_EQ(semGive(mutex), ERROR);
    EXPECT_EQ(semTake(mutex, WAIT_FOREVER), OK);
    EXPECT_EQ(semGive(mutex), OK);
    EXPECT_EQ(semDelete(mutex), OK);
    EXPECT_EQ(semTake(mutex, WAIT_FOREVER), ERROR);
    EXPECT_EQ(error_name(), "S_semLib_NOT_A_SEM");
  });
}

TEST(H2semLibInC, SemaphoresAreNumbers) {
  with_clock([] {
    const H2SEM_ID sem = h2semAlloc(H2SEM_EXCL);
    EXPECT_EQ(h2semTake(sem, 0), TRUE);
    EXPECT_EQ(h2semTake(sem, 1), FALSE);
    EXPECT_EQ(h2semSet(sem, 2), OK);
    EXPECT_EQ(h2semFlush(sem), TRUE);
    EXPECT_EQ(h2semGive(sem), OK);
    EXPECT_EQ(h2semTake(sem, WAIT_FOREVER), TRUE);
    EXPECT_EQ(h2semDelete(sem), OK);
    EXPECT_EQ(h2semGive(sem), ERROR);
  });
}

TEST(WdLibInC, AWatchdogSignalsAnEvent) {
  with_clock([] {
    const WDOG_ID dog = wdCreate();
    EXPECT_EQ(h2evnSignal(taskIdSelf()), ERROR);
    EXPECT_EQ(error_name(), "S_h2evnLib_BAD_TASK_ID");
    EXPECT_EQ(h2evnSusp(1), FALSE);
    EXPECT_EQ(wdStart(
                  dog, 5, [](long task) { h2evnSignal(task); }, taskIdSelf()),
              OK);
    EXPECT_EQ(h2evnSusp(0), TRUE);
    EXPECT_EQ(tickGet(), 7u);
    EXPECT_EQ(wdCancel(dog), OK);
    EXPECT_EQ(wdDelete(dog), OK);
    EXPECT_EQ(wdDelete(dog), ERROR);
  });
}

TEST(H2timerLibInC, ATimerFiresInItsPhase) {
  with_clock([] {
    EXPECT_EQ(h2timerInit(), OK);
    const H2TIMER_ID timer = h2timerAlloc();
    EXPECT_EQ(h2timerStart(timer, 10, 3), OK);
    EXPECT_EQ(h2timerPause(timer), OK);
    EXPECT_EQ(tickGet(), 3u);
    EXPECT_EQ(h2timerPauseReset(timer), OK);
    EXPECT_EQ(tickGet(), 13u);
    EXPECT_EQ(h2timerChangePeriod(timer, 4), OK);
    EXPECT_EQ(h2timerStop(timer), OK);
    EXPECT_EQ(h2timerFree(timer), OK);
    EXPECT_EQ(h2timerFree(timer), ERROR);
    EXPECT_EQ(h2timerEnd(), OK);
  });
}

// The run's declared start is midnight of 1 January 2000, a Saturday.
TEST(H2timeLib, DatesAreVirtual) {
  with_clock([] {
    h2timeInit();
    this_thread::sleep_for(std::chrono::hours(25) + std::chrono::milliseconds(61'234));
    H2TIME date, again;
    H2TIMESPEC since_1970;
    EXPECT_EQ(h2timeGet(&date), OK);
    EXPECT_EQ(date.year, 100);
    EXPECT_EQ(date.month, 1);
    EXPECT_EQ(date.date, 2);
    EXPECT_EQ(date.day, 7);
    EXPECT_EQ(date.hour, 1);
    EXPECT_EQ(date.minute, 1);
    EXPECT_EQ(date.sec, 1);
    EXPECT_EQ(date.msec, 234);
    EXPECT_EQ(date.ntick, 25u * 360'000 + 6'123);
    EXPECT_EQ(h2GetTimeSpec(&since_1970), OK);
    EXPECT_EQ(since_1970.tv_sec, 946'684'800 + 25 * 3600 + 61);
    EXPECT_EQ(since_1970.tv_nsec, 234'000'000);
    timespecFromH2time(&since_1970, &date);
    h2timeFromTimespec(&again, &since_1970);
    EXPECT_EQ(again.ntick, date.ntick);
    taskDelay(7);
    unsigned long ms = 0;
    EXPECT_EQ(h2timeInterval(&date, &ms), OK);
    EXPECT_EQ(ms, 70u);
    EXPECT_EQ(h2timespecInterval(&since_1970, &ms), OK);
    EXPECT_EQ(ms, 70u);
    EXPECT_EQ(h2timeSet(&date), ERROR);
    EXPECT_EQ(h2timeAdj(&date), ERROR);
  });
}

TEST(TickLibInC, TheClockHasOneRate) {
  in_every_order([] {
    EXPECT_EQ(sysClkRateGet(), 0);
    EXPECT_EQ(osInit(50), OK);
    EXPECT_EQ(sysClkRateSet(100), ERROR);
    EXPECT_EQ(errnoGet(), EINVAL);
    EXPECT_EQ(h2initGlob(50), OK);
    EXPECT_EQ(NTICKS_PER_SEC, 50);
    EXPECT_EQ(TICK_US, 20'000);
    tickSet(1000);
    taskDelay(5);
    EXPECT_EQ(tickGet(), 1005u);
    osExit();
  });
}

}  // namespace
}  // namespace waitpoint
