// SPDX-License-Identifier: BSD-3-Clause
// A stack overflow and a use of a bad address are reported with the task's name; earlier signal handlers for such
// faults are still called.
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>

#include "fibers/switch/sanitizer.hpp"
#include "fibers/switch/stack_arena.hpp"
#include "fibers/sync/simulation.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using kernel::StackSize;

// Tests the kernel's own report of a fault: sanitizers and valgrind have theirs.
class StackOverflowDeathTest : public testing::Test {
 protected:
  void SetUp() override {
    const kernel::StackArena looks;
    if (kernel::sanitizer::present) GTEST_SKIP() << "a sanitizer reports faults itself";
  }
};

[[gnu::noinline]] int descend(int depth) {
  volatile char frame[400];
  frame[0] = static_cast<char>(depth);
  return depth < 0 ? 0 : descend(depth + 1) + frame[0];
}

void overflow(StackSize size) {
  SimulationOptions options;
  options.seed = 7;
  options.replay = "the same test again";
  Simulation simulation(options);
  kernel::Robot& robot = simulation.add_robot("rackham");
  simulation.spawn(robot, {.name = "other"}, [] { this_thread::sleep_for(5ms); });
  simulation.spawn(robot, {.name = "deep", .stack = size}, [] {
    this_thread::sleep_for(2ms);
    descend(0);
  });
  simulation.run_before();
}

TEST_F(StackOverflowDeathTest, NamesTheTaskAndSaysHowToRepeatTheRun) {
  EXPECT_EXIT(overflow(StackSize::small), testing::KilledBySignal(SIGABRT),
              "bug: a task ran over the end of its stack\n"
              "  at virtual time 0.002000000 s, in task deep of rackham, at its event [0-9]+ .sleep., seed 7\n"
              "  replay: the same test again\n"
              "  its stack has 16 KiB; a larger one: StackSize::medium .64 KiB. or StackSize::large .256 KiB.");
}

TEST_F(StackOverflowDeathTest, SaysWhichStacksAreLarger) {
  EXPECT_DEATH(overflow(StackSize::medium), "its stack has 64 KiB; a larger one: StackSize::large");
  EXPECT_DEATH(overflow(StackSize::large), "its stack has 256 KiB; there is none larger");
}

TEST_F(StackOverflowDeathTest, IsFoundWhileTheRunIsUnwound) {
  struct Deep {
    ~Deep() { descend(0); }
  };
  EXPECT_DEATH(
      {
        Simulation simulation;
        simulation.spawn(simulation.environment(), {.name = "late"}, [] {
          const Deep deep;
          this_thread::sleep_for(1h);
        });
        simulation.run_before(Time() + Duration(1s));
      },
      "ran over the end of its stack\n.*in task late of environment");
}

// In the first page, which is never mapped. Not null: UndefinedBehaviorSanitizer would report it first.
int* volatile nowhere = reinterpret_cast<int*>(64);

void write_nowhere() {
  simulate([] {
    thread({.name = "wild"}, [] {
      this_thread::sleep_for(3ms);
      *nowhere = 1;
    }).join();
  });
}

TEST_F(StackOverflowDeathTest, AnotherFaultIsPassedOnWithTheTasksName) {
  EXPECT_EXIT(
      write_nowhere(), testing::KilledBySignal(SIGSEGV),
      "the process dies of SIGSEGV .a bad address.\n  at virtual time 0.003000000 s, in task wild of environment");
}

TEST_F(StackOverflowDeathTest, AnotherFaultGoesToTheProgramsOwnHandler) {
  EXPECT_EXIT(
      {
        std::signal(SIGSEGV, [](int) { _exit(42); });
        write_nowhere();
      },
      testing::ExitedWithCode(42), "in task wild");
  EXPECT_EXIT(
      {
        struct sigaction own {};
        own.sa_flags = static_cast<int>(SA_SIGINFO);
        own.sa_sigaction = [](int, siginfo_t* info, void*) { _exit(info->si_addr == nowhere ? 43 : 44); };
        sigaction(SIGSEGV, &own, nullptr);
        write_nowhere();
      },
      testing::ExitedWithCode(43), "in task wild");
}

TEST_F(StackOverflowDeathTest, ASignalThatAnotherProcessSentIsNoFault) {
  const auto let_a_child_send = [] {
    const pid_t own = getpid();
    if (_Fork() == 0) {
      kill(own, SIGSEGV);
      syscall(SYS_exit_group, 0);
    }
    for (;;) pause();
  };
  // The line is that of qemu's user mode.
  EXPECT_EXIT(simulate(let_a_child_send), testing::KilledBySignal(SIGSEGV), "^(qemu: [^\n]*\n)?$");
}

TEST_F(StackOverflowDeathTest, ASignalThatATaskSendsIsItsFault) {
  EXPECT_EXIT(simulate([] { kill(getpid(), SIGSEGV); }), testing::KilledBySignal(SIGSEGV),
              "^waitpoint: the process dies of SIGSEGV \\(the process sent it itself\\)\n.*in task main");
}

TEST_F(StackOverflowDeathTest, AfterARunTheHandlersAreThoseOfBefore) {
  struct sigaction own {
  }, found{};
  own.sa_handler = [](int) { _exit(1); };
  struct sigaction before {};
  sigaction(SIGSEGV, &own, &before);
  stack_t stack_before{}, stack_after{};
  sigaltstack(nullptr, &stack_before);
  EXPECT_TRUE(simulate([] { this_thread::sleep_for(1ms); }).passed);
  sigaction(SIGSEGV, &before, &found);
  sigaltstack(nullptr, &stack_after);
  EXPECT_EQ(found.sa_handler, own.sa_handler);
  EXPECT_EQ(stack_after.ss_sp, stack_before.ss_sp);
  EXPECT_EQ(stack_after.ss_flags, stack_before.ss_flags);
}

TEST_F(StackOverflowDeathTest, AHandlerThatATaskInstalledStays) {
  struct sigaction before {
  }, found{};
  sigaction(SIGSEGV, nullptr, &before);
  void (*const own)(int) = [](int) { _exit(1); };
  EXPECT_TRUE(simulate([own] { std::signal(SIGSEGV, own); }).passed);
  sigaction(SIGSEGV, &before, &found);
  EXPECT_EQ(found.sa_handler, own);
}

}  // namespace
}  // namespace waitpoint
