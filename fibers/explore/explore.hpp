// SPDX-License-Identifier: BSD-3-Clause
// The same test body, run under many schedules, in one process: does any of them fail?
//
//   #include <gtest/gtest.h>            // before this one: its expectations are caught, and reported once
//   #include <waitpoint/fibers/explore/explore.hpp>
//
//   TEST(Mailbox, NeverLosesALetter) {
//     const auto report = waitpoint::explore([] { /* threads, mutexes, ...; waitpoint::check(letters == 1); */ });
//     EXPECT_TRUE(report.passed) << report;
//   }
//
// The body is run from its beginning again and again, within the same process: what it captures or finds in static
// variables must be as it was before. A schedule fails by a deadlock, by a lack of progress, by check(), by an
// exception that escapes from a task, by a GoogleTest expectation; a crash or an abort ends the process, and still says
// how to repeat it, and so does what blocks for real or loops for ever.
//
// Computing takes no virtual time unless the body says so: then all schedules are tried that the order of primitives
// allows. With compute(least, greatest) between them, only those that the times allow.
#pragma once

#include <functional>

#include "fibers/explore/body.hpp"
#include "fibers/explore/explore_options.hpp"
#include "fibers/explore/explore_report.hpp"
#ifdef GTEST_TEST
#include "fibers/explore/googletest.hpp"
#endif

namespace waitpoint {

/// Tries `body` under schedule after schedule until one fails, or `options` say that it is enough. BadInput for options
/// that cannot be meant; what the environment asks for and cannot be meant ends the program with a line and status 2.
/// A token in the options whose run is another one now fails the report, as it is the test's own.
/// To be called from outside any task.
ExploreReport explore_with(exploration::ForeignChecks* checks, std::function<void()> body,
                           const ExploreOptions& options);

/// As above, with the expectations of GoogleTest where that was included before.
static inline ExploreReport explore(std::function<void()> body, const ExploreOptions& options = {}) {
#ifdef GTEST_TEST
  exploration::GoogleTestChecks checks;
  return explore_with(&checks, std::move(body), options);
#else
  return explore_with(nullptr, std::move(body), options);
#endif
}

/// Within a task: the run fails here unless `holds`.
void check(bool holds, const char* message = "a check failed", const char* file = __builtin_FILE(),
           int line = __builtin_LINE());

}  // namespace waitpoint
