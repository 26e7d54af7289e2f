// SPDX-License-Identifier: BSD-3-Clause
// Everything that a program can make grow is bounded, with the errors of the standard library.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <iostream>
#include <system_error>

#include "fibers/switch/sanitizer.hpp"
#include "fibers/switch/stack_arena.hpp"
#include "fibers/sync/simulation.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

SimulationOptions at_most(std::uint32_t tasks) {
  SimulationOptions options;
  options.most_tasks = tasks;
  return options;
}

std::string refusal(const std::function<void()>& function) {
  try {
    function();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::resource_unavailable_try_again);
    return error.what();
  }
  return "none";
}

TEST(Bounds, OneThreadTooManyIsASystemErrorThatNamesIt) {
  const Report report = simulate(
      [] {
        for (int i = 1; i < 100; ++i) thread([] { this_thread::sleep_for(1ms); }).detach();
        const std::string text = refusal([] { thread({.name = "last"}, [] {}).detach(); });
        EXPECT_EQ(text.find("thread last of environment cannot be created: the run has 100 tasks, the most allowed"),
                  0u)
            << text;
        // Ended tasks free their places.
        this_thread::sleep_for(2ms);
        thread([] {}).join();
      },
      at_most(100));
  EXPECT_TRUE(report.passed) << report;
}

TEST(Bounds, UncaughtRefusalFailsTheRun) {
  const Report report = simulate(
      [] {
        for (;;) thread([] { this_thread::sleep_for(1ms); }).detach();
      },
      at_most(10));
  EXPECT_FALSE(report.passed);
  EXPECT_NE(report.text.find("the run has 10 tasks"), std::string::npos) << report;
}

TEST(Bounds, ApplyToTasksSpawnedFromOutside) {
  Simulation simulation(at_most(1));
  simulation.spawn(simulation.environment(), {}, [] {});
  EXPECT_NE(refusal([&] {
              simulation.spawn(simulation.environment(), {.name = "b"}, [] {});
            }).find("thread b of environment"),
            std::string::npos);
  EXPECT_EQ(simulation.run_before(), RunEnd::ended);
}

TEST(BoundsDeathTest, MoreTasksThanTheKernelHoldsCannotBeAskedFor) {
  EXPECT_DEATH(Simulation(at_most(kernel::tasks_max + 1)), "from 1 to 2.20 tasks");
  EXPECT_DEATH(Simulation(at_most(0)), "from 1 to 2.20 tasks");
}

bool address_space_can_be_limited() {
  rlimit before{}, now{};
  if (getrlimit(RLIMIT_AS, &before) != 0) return false;
  const rlimit limit{std::min(before.rlim_cur, rlim_t{1} << 46) - 4096, before.rlim_max};
  if (setrlimit(RLIMIT_AS, &limit) != 0 || getrlimit(RLIMIT_AS, &now) != 0) return false;
  return setrlimit(RLIMIT_AS, &before) == 0 && now.rlim_cur == limit.rlim_cur;
}

// In a separate process with little address space, as after `ulimit -v`. Sanitizers need more than any limit allows.
class AddressSpaceDeathTest : public testing::Test {
 protected:
  void SetUp() override {
    const kernel::StackArena looks;
    if (kernel::sanitizer::present) GTEST_SKIP() << "a sanitizer takes all address space";
    // qemu's user mode answers success, and limits nothing.
    if (!address_space_can_be_limited()) GTEST_SKIP() << "the limit of address space is not obeyed here";
  }
};

void limit_address_space(std::size_t mib) {
  const rlimit limit{mib << 20, mib << 20};
  if (setrlimit(RLIMIT_AS, &limit) != 0) std::abort();
}

[[noreturn]] void tell_and_exit(const std::function<void()>& function) {
  try {
    function();
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    std::exit(3);
  }
  std::exit(0);
}

TEST_F(AddressSpaceDeathTest, ARunThatDoesNotFitSaysSo) {
  EXPECT_EXIT(tell_and_exit([] {
                limit_address_space(1);
                const Simulation simulation;
              }),
              testing::ExitedWithCode(3), "no address space for the run's tables .a limit such as ulimit -v.");
}

TEST_F(AddressSpaceDeathTest, StacksThatAreUsedUpAreToldByTheirSize) {
  EXPECT_EXIT(tell_and_exit([] {
                limit_address_space(2048);
                Simulation simulation;
                for (;;)
                  simulation.spawn(simulation.environment(), {.name = "t", .stack = kernel::StackSize::large}, [] {});
              }),
              testing::ExitedWithCode(3), "thread t of environment cannot be created: no stack of 256 KiB is left");
}

TEST_F(AddressSpaceDeathTest, AFewHundredMegabytesAreEnoughForAFewTasks) {
  EXPECT_EXIT(tell_and_exit([] {
                limit_address_space(1024);
                const Report report = simulate([] {
                  for (int i = 0; i < 50; ++i) thread([] { this_thread::sleep_for(1ms); }).join();
                });
                if (!report.passed) throw std::runtime_error(report.text);
              }),
              testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace waitpoint
