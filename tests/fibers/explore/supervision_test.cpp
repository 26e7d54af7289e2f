// SPDX-License-Identifier: BSD-3-Clause
// Bodies that end the process, or never end: the messages and actions of the supervising process.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <mutex>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

// ThreadSanitizer defers signals until an intercepted call: a loop without one must be killed.
#ifdef __SANITIZE_THREAD__
const testing::KilledBySignal ended(SIGKILL);
#else
const testing::ExitedWithCode ended(1);
#endif

TEST(Explore, ABodyThatCallsExitEndsTheTestProgramWithAFailure) {
  const auto explore_and_leave = [] {
    explore([] {
      atomic<bool> first{false};
      thread other([&] { first.store(true); });
      if (first.load()) std::exit(0);
      other.join();
    });
    std::exit(0);
  };
  EXPECT_EXIT(explore_and_leave(), testing::ExitedWithCode(1), "the process ended within schedule [0-9]+\nreplay: ");
}

TEST(Explore, AScheduleThatGoesOnForLongIsToldAndAtItsLimitEndedWithItsToken) {
  const auto compute_for_ever = [] {
    explore(
        [] {
          for (;;) asm volatile("");
        },
        {.schedule_limit_s = 12});
    std::exit(0);
  };
  EXPECT_EXIT(compute_for_ever(), ended,
              "the default order has run for 10 s;.*\nreplay: WAITPOINT_REPLAY=wx1.1.0+.= .*\n"
              "waitpoint: the default order exceeded the limit of 12 s: process terminated\n"
              "replay: WAITPOINT_REPLAY=wx1.1.0+.= .*\n$");
}

TEST(Explore, AReplayThatDoesNotEndIsEndedWithItsToken) {
  const auto compute_for_ever = [] {
    explore(
        [] {
          for (;;) asm volatile("");
        },
        {.schedule_limit_s = 2, .replay = "wx1.1.01234567.=3-1"});
    std::exit(0);
  };
  EXPECT_EXIT(compute_for_ever(), ended,
              "^waitpoint: the replayed schedule exceeded the limit of 2 s: process terminated\n"
              "replay: WAITPOINT_REPLAY=wx1.1.01234567.=3-1 .*\n$");
}

// As in a chroot. In a mount namespace of the calling process, which needs the rights of root.
bool hide_proc() {
  return unshare(CLONE_NEWNS) == 0 && mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         mount("none", "/proc", "tmpfs", 0, nullptr) == 0;
}

TEST(Explore, AScheduleThatComputesForEverIsEndedWithoutProc) {
  const pid_t child = fork();
  if (child == 0) _exit(hide_proc() ? 0 : 1);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  if (status != 0) GTEST_SKIP() << "/proc cannot be hidden here";
  const auto compute_for_ever = [] {
    hide_proc();
    explore(
        [] {
          for (;;) asm volatile("");
        },
        {.schedule_limit_s = 2, .replay = "wx1.1.01234567.=3-1"});
    std::exit(0);
  };
  EXPECT_EXIT(compute_for_ever(), ended, "the replayed schedule exceeded the limit of 2 s: process terminated\n");
}

TEST(Explore, BlockingOutsideTheSimulationEndsTheScheduleWithItsToken) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "ThreadSanitizer tells of the real lock too";
#endif
  const auto lock_a_real_lock_twice = [] {
    explore([] {
      atomic<bool> first{false};
      thread other([&] { first.store(true); });
      std::timed_mutex real;
      real.lock();
      if (first.load()) (void)real.try_lock_for(1h);
      other.join();
    });
    std::exit(0);
  };
  EXPECT_EXIT(
      lock_a_real_lock_twice(), ended,
      "^waitpoint: schedule [0-9]+ was blocked for 10 s by something that is not simulated, such as a real lock or "
      "input: process terminated\nreplay: WAITPOINT_REPLAY=wx1.1.0+.portfolio.1.[0-9]+ .*\n$");
}

}  // namespace
}  // namespace waitpoint
