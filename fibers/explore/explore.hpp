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

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

#include "core/time.hpp"
#include "fibers/explore/body.hpp"
#ifdef GTEST_TEST
#include "fibers/explore/googletest.hpp"
#endif

namespace waitpoint {

/// Each is replaced by the environment's WAITPOINT_STRATEGY, _SEED, _ITERATIONS, _TIME_LIMIT and _SCHEDULE_LIMIT
/// (seconds), _REPLAY where that is set.
struct ExploreOptions {
  std::string strategy = "portfolio";
  std::uint64_t seed = 1;
  std::uint64_t iterations = 10'000;    ///< schedules, at most
  double time_limit_s = 0;              ///< of the wall clock; 0: none
  std::uint32_t schedule_limit_s = 60;  ///< of one: what takes longer ends the program; 0: none does
  std::string replay = {};              ///< a token: that schedule alone
  bool races = true;                    ///< a data race is a failure, though it did no harm; see races/races.hpp
  bool minimize = true;                 ///< what failed, to the fewest switches that still fail
  Time until = Time() + std::chrono::hours(1);  ///< a schedule that has not ended then fails
  std::uint32_t steps_max = 100'000;            ///< switch points at one instant, after which there is no progress
};

struct ExploreReport {
  bool passed = false;
  std::string text;  ///< of a failure: what happened, where, why, and the line that repeats it; else empty
  std::uint64_t schedules = 0;
  std::uint64_t distinct = 0;
  bool complete = false;   ///< all there are were tried, as an exhaustive strategy knows, but for spurious wake-ups
  std::string scope = {};  ///< where an exhaustive strategy came to its end: of what it tried all, in words
  std::size_t leaked_bytes = 0;  ///< of the heap, that the default schedule leaves in use each time
  double seconds = 0;
  std::uint64_t failed_at = 0;     ///< the number of the schedule that failed
  exploration::Schedule schedule;  ///< that failed; the least that was found
  std::string replay;              ///< the token of the failure
};

std::ostream& operator<<(std::ostream& out, const ExploreReport& report);

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
