// SPDX-License-Identifier: BSD-3-Clause
// Threads, processes and waits of the operating system in a task are named with the task, the virtual time and the
// line.
#include <gtest/gtest.h>
#include <semaphore.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <thread>

#include "fibers/explore/explore.hpp"
#include "fibers/switch/sanitizer.hpp"
#include "fibers/switch/stack_arena.hpp"
#include "fibers/sync/simulation.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

// In a process of its own, since each place of a call is told once in a process.
class SystemCallsDeathTest : public testing::Test {
 protected:
  void SetUp() override {
    const kernel::StackArena looks;
    if (kernel::sanitizer::present) GTEST_SKIP() << "a sanitizer has these functions itself";
  }

  static void expect_told(const std::function<void()>& body, const std::string& function, const std::string& effect) {
    const auto run = [&] {
      simulate([&] {
        this_thread::sleep_for(3ms);
        body();
        body();
      });
      std::exit(0);
    };
    const std::string told =
        "waitpoint: warning: task main of environment calls " + function + "\\(\\) at 0\\.003000000 s: it " + effect;
    EXPECT_EXIT(run(), testing::ExitedWithCode(0), told) << function;
    EXPECT_EXIT(run(), testing::ExitedWithCode(0), "    at .*system_calls_test.cpp:[0-9]+") << function;
  }
};

TEST_F(SystemCallsDeathTest, StartsOfRealThreadsAndProcessesAreNamed) {
  expect_told([] { std::thread([] {}).join(); }, "pthread_create", "runs in real time, and the run is not repeatable");
  expect_told(
      [] {
        const pid_t child = fork();
        if (child == 0) _exit(0);
        waitpid(child, nullptr, 0);
      },
      "fork", "runs in real time, and the run is not repeatable");
}

TEST_F(SystemCallsDeathTest, SleepsInRealTimeAreNamed) {
  const char effect[] = "holds up all tasks of the run in real time";
  expect_told([] { std::this_thread::sleep_for(1ms); }, "(clock_)?nanosleep", effect);
  expect_told([] { ::usleep(100); }, "usleep", effect);
  sem_t semaphore;
  sem_init(&semaphore, 0, 2);
  std::atomic<int> word = 0;
  expect_told(
      [&] {
        std::thread waker([&] {
          std::this_thread::sleep_for(2ms);
          ++word;
          word.notify_all();
        });
        word.wait(word);
        waker.join();
      },
      "futex", effect);
}

TEST_F(SystemCallsDeathTest, CallsOfThreadsOutsideTheRunAreIgnored) {
  EXPECT_EXIT(
      {
        std::atomic<bool> ended = false;
        std::thread other([&] {
          while (!ended) std::this_thread::sleep_for(100us);
        });
        simulate([] {
          for (int i = 0; i < 1000; ++i) this_thread::sleep_for(3ms);
        });
        ended = true;
        other.join();
        std::fputs("quiet\n", stderr);
        std::exit(0);
      },
      testing::ExitedWithCode(0), "^quiet\n$");
}

TEST_F(SystemCallsDeathTest, ThreadsStartedBeforeTheRunAreNamedOnRequest) {
  EXPECT_EXIT(
      {
        std::thread([] {}).join();
        sync::tell_threads_outside();
        std::exit(0);
      },
      testing::ExitedWithCode(0),
      "warning: a thread of the operating system was started outside of tasks; it is not repeatable\n    at "
      ".*system_calls_test.cpp:");
}

void lock_what_another_task_holds() {
  std::mutex of_the_system;
  simulate([&] {
    thread holder({.name = "holder"}, [&] {
      const std::lock_guard lock(of_the_system);
      this_thread::sleep_for(1ms);
    });
    thread taker({.name = "taker"}, [&] { const std::lock_guard lock(of_the_system); });
    holder.join();
    taker.join();
  });
}

TEST_F(SystemCallsDeathTest, LockingASystemMutexOfAnotherTaskEndsTheRun) {
  EXPECT_EXIT(lock_what_another_task_holds(), testing::KilledBySignal(SIGABRT),
              "a task locks a mutex of the system, such as std::mutex, that a task holds already: no task can run\n"
              ".*in task taker of environment");
}

TEST_F(SystemCallsDeathTest, DoNotIncludeALockThatIsFree) {
  EXPECT_EXIT(
      {
        std::mutex of_the_system;
        simulate([&] { const std::lock_guard lock(of_the_system); });
        std::fputs("quiet\n", stderr);
        std::exit(0);
      },
      testing::ExitedWithCode(0), "^quiet\n$");
}

TEST_F(SystemCallsDeathTest, FailAnExploredBodyThatStartsThem) {
  EXPECT_EXIT(
      {
        const auto report = explore([] { std::thread([] {}).join(); }, {.iterations = 1000});
        std::cerr << report;
        std::exit(report.passed ? 0 : 3);
      },
      testing::ExitedWithCode(3),
      "a task starts a thread or process of the operating system, whose steps are not explored");
}

}  // namespace
}  // namespace waitpoint
