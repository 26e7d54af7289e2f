// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/semLib.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <climits>
#include <string>
#include <vector>

#include "fibers/laas/taskLib.hpp"
#include "tests/fibers/laas/laas_run.hpp"

namespace waitpoint::laas {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

// pocolibs' own regression test: two tasks that take and give in loops.
TEST(SemLib, TwoTasksThatLoopOverAMutexAlternateStrictly) {
  with_clock([] {
    const SEM_ID mutex = semMCreate(SEM_Q_PRIORITY);
    std::string order;
    std::vector<thread> threads;
    for (const char name : {'a', 'b'})
      threads.emplace_back([&, name] {
        for (int i = 0; i < 50; ++i) {
          ASSERT_EQ(semTake(mutex, WAIT_FOREVER), OK);
          order += name;
          sleep_for(1ms);  // lets the other begin to wait
          ASSERT_EQ(semGive(mutex), OK);
        }
      });
    for (thread& t : threads) t.join();
    ASSERT_EQ(order.size(), 100u);
    for (std::size_t i = 2; i < order.size(); ++i) ASSERT_EQ(order[i], order[i - 2]) << order;
    ASSERT_NE(order[0], order[1]);
  });
}

TEST(SemLib, AMutexServesFirstComeFirstServedInEveryOrder) {
  with_clock([] {
    const SEM_ID mutex = semMCreate(SEM_Q_FIFO);
    semTake(mutex, WAIT_FOREVER);
    std::string order;
    std::vector<thread> threads;
    for (const char name : {'a', 'b', 'c', 'd', 'e'})
      threads.emplace_back([&, name] {
        sleep_for((name - 'a') * 1ms);
        semTake(mutex, WAIT_FOREVER);
        order += name;
        semGive(mutex);
      });
    sleep_for(1s);
    semGive(mutex);
    for (thread& t : threads) t.join();
    EXPECT_EQ(order, "abcde");
  });
}

// pocolibs accepts SEM_Q_PRIORITY, but serves first come, first served.
TEST(SemLib, TheQueueIsFirstComeFirstServedWhateverThePriorities) {
  with_clock([] {
    const SEM_ID mutex = semMCreate(SEM_Q_PRIORITY);
    semTake(mutex, WAIT_FOREVER);
    std::string order;
    for (const char name : {'a', 'b', 'c'})
      taskSpawn(std::string(1, name).c_str(), 200 - 50 * (name - 'a'), 0, 20000, [&, name] {
        sleep_for((name - 'a' + 1) * 1ms);
        semTake(mutex, WAIT_FOREVER);
        order += name;
        semGive(mutex);
      });
    sleep_for(1s);
    semGive(mutex);
    sleep_for(1s);
    EXPECT_EQ(order, "abc");
  });
}

// In pocolibs a failed try draws a ticket that is never served, which blocks the mutex.
TEST(SemLib, AFailedTryLeavesNoTicketBehind) {
  with_clock([] {
    const SEM_ID mutex = semMCreate(SEM_Q_FIFO);
    thread holder([&] {
      semTake(mutex, WAIT_FOREVER);
      sleep_for(50ms);
      semGive(mutex);
    });
    sleep_for(1ms);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(semTake(mutex, NO_WAIT), ERROR);
      EXPECT_EQ(errnoGet(), S_semLib_TIMEOUT);
    }
    EXPECT_EQ(semTake(mutex, 1), ERROR);  // nor does a timeout
    EXPECT_EQ(semTake(mutex, WAIT_FOREVER), OK);
    EXPECT_EQ(now(), Time() + Duration(50ms));
    EXPECT_EQ(semGive(mutex), OK);
    EXPECT_EQ(semTake(mutex, NO_WAIT), OK);
    holder.join();
  });
}

TEST(SemLib, ATimeOutOfNTicksEndsAtTheNPlusFirst) {
  with_clock([] {
    for (const SEM_ID sem : {semBCreate(0, SEM_EMPTY), semCCreate(0, 0)}) {
      const std::int64_t before = static_cast<std::int64_t>(tickGet());
      sleep_until_tick(before);
      for (const int n : {1, 2, 5, 100}) {
        const auto start = static_cast<std::int64_t>(tickGet());
        EXPECT_EQ(semTake(sem, n), ERROR);
        EXPECT_EQ(errnoGet(), S_semLib_TIMEOUT);
        EXPECT_EQ(now(), tick(start + n + 1));
        sleep_for(7ms);  // the same from between two ticks
      }
      sleep_until_tick(static_cast<std::int64_t>(tickGet()) + 1);
    }
  });
}

TEST(SemLib, GivenAtTheInstantOfTheTimeOutTheUnitIsNeverLost) {
  expect_both([] {
    h2initGlob(100);
    const SEM_ID sem = semBCreate(0, SEM_EMPTY);
    STATUS status = ERROR;
    thread waiter([&] { status = semTake(sem, 4); });
    sleep_until_tick(5);
    semGive(sem);
    waiter.join();
    EXPECT_EQ(semTake(sem, NO_WAIT), status == OK ? ERROR : OK);
    return status == OK;
  });
}

TEST(SemLib, BinaryAndCountingSemaphoresCountWithoutSaturating) {
  with_clock([] {
    const SEM_ID binary = semBCreate(SEM_Q_FIFO, SEM_FULL);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(semGive(binary), OK);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(semTake(binary, NO_WAIT), OK);
    EXPECT_EQ(semTake(binary, NO_WAIT), ERROR);
    const SEM_ID counting = semCCreate(SEM_Q_FIFO, INT_MAX);
    EXPECT_EQ(semGive(counting), ERROR);
    EXPECT_EQ(errnoGet(), EOVERFLOW);
    EXPECT_EQ(semCCreate(SEM_Q_FIFO, -1), nullptr);
    EXPECT_EQ(errnoGet(), EINVAL);
  });
}

TEST(SemLib, GiveServesAWaiter) {
  with_clock([] {
    const SEM_ID sem = semCCreate(SEM_Q_FIFO, 0);
    int served = 0;
    std::vector<thread> threads;
    for (int i = 0; i < 3; ++i)
      threads.emplace_back([&] {
        EXPECT_EQ(semTake(sem, 1000), OK);
        ++served;
      });
    for (int i = 1; i <= 3; ++i) {
      sleep_for(1ms);
      semGive(sem);
      sleep_for(1ms);
      EXPECT_EQ(served, i);
    }
    EXPECT_EQ(semTake(sem, NO_WAIT), ERROR);
    for (thread& t : threads) t.join();
  });
}

TEST(SemLib, AFlushLetsAllGoOnAndKeepsTheCount) {
  with_clock([] {
    const SEM_ID sem = semBCreate(SEM_Q_FIFO, SEM_EMPTY);
    std::vector<thread> threads;
    for (int i = 0; i < 3; ++i)
      threads.emplace_back([&] {
        EXPECT_EQ(semTake(sem, WAIT_FOREVER), OK);
        EXPECT_EQ(now(), tick(3));
      });
    sleep_until_tick(3);
    EXPECT_EQ(semFlush(sem), OK);
    EXPECT_EQ(semTake(sem, NO_WAIT), ERROR);
    for (thread& t : threads) t.join();
    EXPECT_EQ(semFlush(semMCreate(SEM_Q_FIFO)), ERROR);
  });
}

TEST(SemLib, DeletionWakesWaitersAndInvalidatesTheSemaphore) {
  with_clock([] {
    const SEM_ID sem = semCCreate(SEM_Q_FIFO, 0);
    thread waiter([&] {
      EXPECT_EQ(semTake(sem, WAIT_FOREVER), ERROR);
      EXPECT_EQ(errnoGet(), S_semLib_NOT_A_SEM);
      EXPECT_EQ(now(), tick(2));
    });
    sleep_until_tick(2);
    EXPECT_EQ(semDelete(sem), OK);
    EXPECT_EQ(semTake(sem, NO_WAIT), ERROR);
    EXPECT_EQ(semGive(sem), ERROR);
    EXPECT_EQ(semDelete(sem), ERROR);
    EXPECT_EQ(semFlush(sem), ERROR);
    EXPECT_EQ(semGive(nullptr), ERROR);
    EXPECT_EQ(errnoGet(), S_semLib_NOT_A_SEM);
    waiter.join();
  });
}

TEST(SemLib, OnlyTheHolderGivesAMutexAndNoTimeOutIsNegative) {
  with_clock([] {
    const SEM_ID mutex = semMCreate(SEM_Q_FIFO);
    EXPECT_EQ(semGive(mutex), ERROR);
    EXPECT_EQ(errnoGet(), EPERM);
    semTake(mutex, WAIT_FOREVER);
    thread([&] { EXPECT_EQ(semGive(mutex), ERROR); }).join();
    EXPECT_EQ(semTake(mutex, -2), ERROR);
    EXPECT_EQ(errnoGet(), EINVAL);
  });
}

TEST(SemLib, TakingAMutexTwiceIsADeadlock) {
  const Report report = simulate([] {
    const SEM_ID mutex = semMCreate(SEM_Q_FIFO);
    semTake(mutex, WAIT_FOREVER);
    semTake(mutex, WAIT_FOREVER);
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_NE(report.text.find("waits for itself"), std::string::npos) << report;
}

TEST(SemLib, ThereAreSoManyAndNoMore) {
  const Report report = simulate([] {
    std::vector<SEM_ID> made;
    for (std::size_t i = 0; i < semaphores_max; ++i) made.push_back(semBCreate(0, SEM_EMPTY));
    EXPECT_NE(made.back(), nullptr);
    EXPECT_EQ(semBCreate(0, SEM_EMPTY), nullptr);
    EXPECT_EQ(errnoGet(), S_semLib_TOO_MANY_SEM);
    semDelete(made[5]);
    EXPECT_NE(semMCreate(0), nullptr);
  });
  EXPECT_TRUE(report.passed) << report;
}

TEST(SemLibDeathTest, AFiniteTimeOutNeedsAClock) {
  EXPECT_DEATH(simulate([] { semTake(semBCreate(0, SEM_EMPTY), 5); }), "h2initGlob\\(\\) started no clock");
}

}  // namespace
}  // namespace waitpoint::laas
