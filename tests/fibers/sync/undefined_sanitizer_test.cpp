// SPDX-License-Identifier: BSD-3-Clause
// In a program built with UndefinedBehaviorSanitizer: an error in a task ends the program with its source line.
#include <gtest/gtest.h>

#include <chrono>
#include <limits>

#include "fibers/sync/simulation.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

TEST(UndefinedSanitizerDeathTest, OverflowInATaskIsFound) {
  EXPECT_DEATH(simulate([] {
                 volatile int number = std::numeric_limits<int>::max();
                 this_thread::sleep_for(std::chrono::microseconds(1));
                 number = number + 1;
               }),
               "undefined_sanitizer_test.cpp.*signed integer overflow");
}

}  // namespace
}  // namespace waitpoint
