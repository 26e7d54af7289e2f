// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/pacing.hpp"

#include <gtest/gtest.h>

namespace waitpoint::tools {
namespace {

double fake_now_s = 0;
double fake_clock() { return fake_now_s; }

Time at_s(double seconds) { return Time() + Duration::from_seconds(seconds); }

const auto never = [] { return false; };
// Ends a wait at once, as a signal does.
const auto at_once = [] { return true; };

TEST(Pacing, ReportsTheLagOfEachWait) {
  fake_now_s = 10;
  Pacing pacing(2, fake_clock);
  EXPECT_FALSE(pacing.lag());
  fake_now_s = 10.25;
  pacing.wait_for(at_s(1), at_once);  // due at 10.5: in time
  fake_now_s = 11.5;
  pacing.wait_for(at_s(2), never);  // due at 11
  fake_now_s = 11.75;
  pacing.wait_for(at_s(3), never);  // due at 11.5
  ASSERT_TRUE(pacing.lag());
  EXPECT_DOUBLE_EQ(pacing.lag()->max_s, 0.5);
  EXPECT_DOUBLE_EQ(pacing.lag()->mean_s, 0.25);
}

TEST(Pacing, RestartsAtAnotherSpeedOrAfterAPause) {
  fake_now_s = 0;
  Pacing pacing(1, fake_clock);
  fake_now_s = 100;
  pacing.restart(at_s(5), 4);
  EXPECT_EQ(pacing.speed(), 4);
  fake_now_s = 101;
  pacing.wait_for(at_s(9), never);
  EXPECT_DOUBLE_EQ(pacing.lag()->max_s, 0);
  fake_now_s = 101.5;
  pacing.wait_for(at_s(9), never);
  EXPECT_DOUBLE_EQ(pacing.lag()->max_s, 0.5);
}

TEST(Pacing, UnpacedRunHasNoLag) {
  Pacing pacing(0, fake_clock);
  pacing.wait_for(at_s(1000), never);
  EXPECT_FALSE(pacing.lag());
}

TEST(Pacing, PollDuringAWaitCanLiftThePace) {
  const double start_s = wall_clock_s();
  Pacing pacing(0.001);
  pacing.wait_for(at_s(1), [&] {
    pacing.restart(Time(), 0);
    return false;
  });
  EXPECT_LT(wall_clock_s() - start_s, 100) << "at the first speed it would be 1000 s";
}

}  // namespace
}  // namespace waitpoint::tools
