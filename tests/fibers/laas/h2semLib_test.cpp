// SPDX-License-Identifier: BSD-3-Clause
// comLib's semaphores and events.
#include "fibers/laas/h2semLib.hpp"

#include <gtest/gtest.h>

#include <cerrno>

#include "fibers/laas/h2evnLib.hpp"
#include "fibers/laas/taskLib.hpp"
#include "tests/fibers/laas/laas_run.hpp"

namespace waitpoint::laas {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(H2SemLib, ATimeOutOfZeroIsForEver) {
  with_clock([] {
    const H2SEM_ID sem = h2semAlloc(H2SEM_SYNC);
    thread giver([&] {
      for (int i = 0; i < 2; ++i) {
        sleep_for(1h);
        EXPECT_EQ(h2semGive(sem), OK);
      }
    });
    EXPECT_EQ(h2semTake(sem, 0), TRUE);
    EXPECT_EQ(now(), Time() + Duration(1h));
    EXPECT_EQ(h2semTake(sem, WAIT_FOREVER), TRUE);
    EXPECT_EQ(now(), Time() + Duration(2h));
    giver.join();
  });
}

TEST(H2SemLib, ATimeOutOfNTicksEndsAtTheNPlusFirst) {
  with_clock([] {
    const H2SEM_ID sem = h2semAlloc(H2SEM_SYNC);
    sleep_for(13ms);
    EXPECT_EQ(h2semTake(sem, 3), FALSE);
    EXPECT_EQ(errnoGet(), S_h2semLib_TIMEOUT);
    EXPECT_EQ(now(), tick(5));
    EXPECT_EQ(h2evnSusp(3), FALSE);
    EXPECT_EQ(errnoGet(), S_h2semLib_TIMEOUT);
    EXPECT_EQ(now(), tick(9));
  });
}

TEST(H2SemLib, StartsAsItsTypeSaysAndCounts) {
  with_clock([] {
    const H2SEM_ID exclusive = h2semAlloc(H2SEM_EXCL);
    const H2SEM_ID synchronous = h2semAlloc(H2SEM_SYNC);
    EXPECT_NE(exclusive, synchronous);
    EXPECT_EQ(h2semTake(exclusive, 1), TRUE);
    EXPECT_EQ(h2semTake(exclusive, 1), FALSE);
    for (int i = 0; i < 3; ++i) h2semGive(synchronous);
    EXPECT_EQ(h2semTake(synchronous, 1), TRUE);
    EXPECT_EQ(h2semFlush(synchronous), TRUE);  // removes two
    EXPECT_EQ(h2semTake(synchronous, 1), FALSE);
    EXPECT_EQ(h2semSet(synchronous, 2), OK);
    EXPECT_EQ(h2semTake(synchronous, 0), TRUE);
    EXPECT_EQ(h2semTake(synchronous, 0), TRUE);
    EXPECT_EQ(h2semTake(synchronous, 1), FALSE);
  });
}

TEST(H2SemLib, MisuseIsAnErrorCode) {
  with_clock([] {
    EXPECT_EQ(h2semAlloc(7), ERROR);
    EXPECT_EQ(errnoGet(), S_h2semLib_BAD_SEM_TYPE);
    const H2SEM_ID sem = h2semAlloc(H2SEM_SYNC);
    EXPECT_EQ(h2semTake(sem, -2), FALSE);
    EXPECT_EQ(errnoGet(), EINVAL);
    EXPECT_EQ(h2semSet(sem, -1), ERROR);
    thread waiter([&] {
      EXPECT_EQ(h2semTake(sem, 0), FALSE);
      EXPECT_EQ(errnoGet(), S_h2semLib_NOT_A_SEM);
    });
    sleep_for(1ms);
    EXPECT_EQ(h2semDelete(sem), OK);
    waiter.join();
    for (const H2SEM_ID no_semaphore : {sem, 0, -1, 12345}) {
      EXPECT_EQ(h2semTake(no_semaphore, 0), FALSE);
      EXPECT_EQ(errnoGet(), S_h2semLib_NOT_A_SEM);
      EXPECT_EQ(h2semGive(no_semaphore), ERROR);
      EXPECT_EQ(h2semDelete(no_semaphore), ERROR);
      EXPECT_EQ(h2semFlush(no_semaphore), FALSE);
    }
    for (int i = 0; i < h2_semaphores_max; ++i) EXPECT_NE(h2semAlloc(H2SEM_SYNC), ERROR);
    EXPECT_EQ(h2semAlloc(H2SEM_SYNC), ERROR);
    EXPECT_EQ(errnoGet(), S_h2semLib_TOO_MANY_SEM);
  });
}

TEST(H2EvnLib, EventsAreCountedFromTheFirstSuspOn) {
  with_clock([] {
    int taken = 0;
    const long id = taskSpawn("control", 10, 0, 20000, [&] {
      EXPECT_EQ(h2evnSusp(0), TRUE);
      EXPECT_EQ(now(), tick(2));
      sleep_until_tick(3);
      while (h2evnSusp(1) == TRUE) ++taken;
      sleep_until_tick(10);
      h2evnClear();
      EXPECT_EQ(h2evnSusp(1), FALSE);
    });
    EXPECT_EQ(h2evnSignal(id), ERROR);  // it has not waited yet
    EXPECT_EQ(errnoGet(), S_h2evnLib_BAD_TASK_ID);
    sleep_until_tick(2);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(h2evnSignal(id), OK);
    sleep_until_tick(7);
    EXPECT_EQ(taken, 3);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(h2evnSignal(id), OK);
    sleep_until_tick(20);
    EXPECT_EQ(h2evnSignal(id), ERROR);  // it has ended
    h2evnClear();
  });
}

}  // namespace
}  // namespace waitpoint::laas
