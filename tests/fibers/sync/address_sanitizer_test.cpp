// SPDX-License-Identifier: BSD-3-Clause
// In a program built with AddressSanitizer: it reports the errors of tasks like those of threads, without false
// reports.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <vector>

#include "fibers/sync/simulation.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

// Many frames, so that a task's frames reuse the memory of another's, with a switch at every depth.
int sum_to(int n) {
  volatile int numbers[16] = {};
  numbers[n % 16] = n;
  this_thread::sleep_for(1us);
  return n == 0 ? 0 : numbers[n % 16] + sum_to(n - 1);
}

TEST(AddressSanitizer, SwitchesExceptionsAndReusedStacksAreNoErrors) {
  in_every_order([] {
    for (int round = 0; round < 5; ++round) {
      std::vector<thread> threads;
      for (int i = 0; i < 10; ++i)
        threads.emplace_back([i] {
          EXPECT_EQ(sum_to(i), i * (i + 1) / 2);
          try {
            sum_to(3);
            throw std::runtime_error("thrown in a task");
          } catch (const std::runtime_error&) {
            EXPECT_EQ(sum_to(4), 10);
          }
        });
      for (thread& t : threads) t.join();
    }
  });
}

TEST(AddressSanitizer, TasksThatAreUnwoundLeaveNothingOnTheirStacks) {
  for (int round = 0; round < 3; ++round) {
    Simulation simulation;
    for (int i = 0; i < 10; ++i) simulation.spawn(simulation.environment(), {}, [] { sum_to(1000); });
    simulation.run_before(Time::from_ns(10'000));
  }
}

TEST(AddressSanitizerDeathTest, OverflowOnATasksStackIsFound) {
  EXPECT_DEATH(simulate([] {
                 volatile int numbers[4] = {};
                 volatile int place = 4;
                 this_thread::sleep_for(1us);
                 numbers[place] = 1 + numbers[0];
               }),
               "stack-buffer-overflow");
}

TEST(AddressSanitizerDeathTest, UseOfWhatAnotherTaskFreedIsFound) {
  EXPECT_DEATH(simulate([] {
                 auto value = std::make_unique<int>(1);
                 volatile int* address = value.get();
                 thread other([&] { value.reset(); });
                 other.join();
                 *address = 2;
               }),
               "heap-use-after-free");
}

TEST(AddressSanitizerDeathTest, UseOfAnotherTasksDeadFrameIsFound) {
  EXPECT_DEATH(simulate([] {
                 volatile int* address = nullptr;
                 thread other([&] {
                   {
                     volatile int gone = 1;
                     address = &gone;
                   }
                   this_thread::sleep_for(2us);
                 });
                 this_thread::sleep_for(1us);
                 *address = 2;
                 other.join();
               }),
               "stack-use-after-scope");
}

// Ends the process during a run.
[[noreturn]] void run_and_exit(bool leak) {
  static Simulation* simulation = nullptr;
  simulation = new Simulation();
  for (int i = 0; i < 5; ++i)
    simulation->spawn(simulation->environment(), {}, [leak] {
      auto owned = std::make_unique<std::vector<int>>(1000);
      if (leak) {
        (void)owned.release();
        owned = std::make_unique<std::vector<int>>(2000);
      }
      this_thread::sleep_for(1s);
    });
  simulation->run_before(Time::from_ns(1000));
  std::exit(0);
}

TEST(AddressSanitizerDeathTest, LeaksAreFoundAndWhatAParkedTaskHoldsIsNone) {
  EXPECT_EXIT(run_and_exit(false), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(run_and_exit(true), testing::ExitedWithCode(1), "detected memory leaks");
}

}  // namespace
}  // namespace waitpoint
