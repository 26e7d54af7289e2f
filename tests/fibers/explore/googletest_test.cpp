// SPDX-License-Identifier: BSD-3-Clause
// GoogleTest's expectations and skips in a body, over many schedules.
#include <gtest/gtest.h>

#include <string>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

TEST(ExploreWithGoogleTest, AnExpectationThatFailsIsCaughtAndReportedOnce) {
  int runs = 0;
  const ExploreReport report = explore([&] {
    ++runs;
    atomic<int> turn{0};
    thread other([&] { turn.store(1); });
    EXPECT_EQ(turn.load(), 0) << "the other was first";
    other.join();
  });
  EXPECT_FALSE(report.passed);
  EXPECT_GT(runs, 3);
  EXPECT_NE(report.text.find("expectation at "), std::string::npos) << report;
  EXPECT_NE(report.text.find("the other was first"), std::string::npos) << report;
}

TEST(ExploreWithGoogleTest, ABodyThatSkipsTheTestSkipsItOnce) {
  testing::TestPartResultArray told;
  {
    testing::ScopedFakeTestPartResultReporter test(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &told);
    explore([] {
      thread other([] {});
      other.join();
      GTEST_SKIP() << "there is no device";
    });
  }
  ASSERT_EQ(told.size(), 1);
  EXPECT_TRUE(told.GetTestPartResult(0).skipped());
  EXPECT_NE(std::string(told.GetTestPartResult(0).message()).find("there is no device"), std::string::npos);
}

TEST(ExploreWithGoogleTest, AScheduleThatSkipsOnlyLeavesWhereTheDefaultOrderDoesNot) {
  testing::TestPartResultArray told;
  ExploreReport report;
  {
    testing::ScopedFakeTestPartResultReporter test(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &told);
    report = explore([] {
      atomic<int> turn{0};
      thread other([&] { turn.store(1); });
      const bool is_late = turn.load() == 1;
      other.join();
      if (is_late) GTEST_SKIP() << "too late";
    });
  }
  EXPECT_EQ(told.size(), 0);
  EXPECT_TRUE(report.passed) << report;
}

}  // namespace
}  // namespace waitpoint
