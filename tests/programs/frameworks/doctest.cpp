// SPDX-License-Identifier: BSD-3-Clause
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include "tests/programs/frameworks/tests_of_threads.hpp"

TEST_CASE("passes with a warning") {
  const auto report = waitpoint::explore([] {
    WARN(count_by_two_threads() == 2);
    WARN_MESSAGE(count_by_two_threads() == 2, "one is lost");
  });
  INFO(report);
  CHECK(report.passed);
}
