// SPDX-License-Identifier: BSD-3-Clause
// Runs a test body under many schedules in one process, until one fails.
//
//   #include <gtest/gtest.h>            // or Catch2, or doctest; before this one: then its expectations are caught
//   #include <waitpoint/fibers/explore/explore.hpp>
//
//   TEST(Mailbox, NeverLosesALetter) {
//     const auto report = waitpoint::explore([] { /* threads, mutexes, ...; waitpoint::check(letters == 1); */ });
//     EXPECT_TRUE(report.passed) << report;
//   }
//
// The body is run repeatedly from its beginning within the same process: captured and static variables must have the
// same values at each start. A schedule fails by a deadlock, by a lack of progress, by check(), by an exception that
// escapes from a task, or by an expectation of the test framework. A crash, an abort, a real blocking call or an
// endless loop ends the process, after printing the replay line.
//
// By default computing takes no virtual time: then all schedules that the order of primitives allows are possible. With
// compute(least, greatest) between primitives, only those within the declared times.
#pragma once

#include <functional>

#include "fibers/explore/body.hpp"
#include "fibers/explore/check.hpp"
#include "fibers/explore/explore_report.hpp"
#include "fibers/explore/target/explore_options.hpp"
#if defined(GTEST_TEST)
#include "fibers/explore/googletest.hpp"
#elif defined(CATCH_VERSION_MAJOR) || defined(CATCH_TEST_MACROS_HPP_INCLUDED)
#include "fibers/explore/catch2.hpp"
#elif defined(DOCTEST_LIBRARY_INCLUDED)
#include "fibers/explore/doctest.hpp"
#endif

namespace waitpoint {

/// Runs `body` under different schedules until one fails, or a limit of `options` is reached. Throws BadInput for
/// invalid options; invalid environment variables end the program with a line and status 2. A token in the options that
/// no longer matches its run is a failure of the report, as it is the test's own. Must be called outside any task. One
/// thread explores at a time: another one's call waits.
ExploreReport explore_with(exploration::ExternalChecks* checks, std::function<void()> body,
                           const ExploreOptions& options);

/// As above, with the expectations of the test framework whose header was included before.
static inline ExploreReport explore(std::function<void()> body, const ExploreOptions& options = {}) {
#if defined(GTEST_TEST)
  exploration::GoogleTestChecks checks;
  return explore_with(&checks, std::move(body), options);
#elif defined(WAITPOINT_CATCH2)
  exploration::CatchChecks checks;
  return explore_with(&checks, std::move(body), options);
#elif defined(DOCTEST_LIBRARY_INCLUDED)
  exploration::DoctestChecks checks;
  return explore_with(&checks, std::move(body), options);
#else
  return explore_with(nullptr, std::move(body), options);
#endif
}

}  // namespace waitpoint
