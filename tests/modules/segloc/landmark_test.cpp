// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/landmark.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace waitpoint::segloc {
namespace {

TEST(Coverage, StretchesThatTouchBecomeOneAndOthersStayApart) {
  Coverage seen;
  seen.add({2, 3}, 0.3);
  seen.add({5, 6}, 0.3);
  seen.add({0, 1}, 0.3);
  ASSERT_EQ(seen.stretches().size(), 3u);
  EXPECT_EQ(seen.length_m(), 3);
  seen.add({1.2, 1.8}, 0.3);  // closes the first two
  ASSERT_EQ(seen.stretches().size(), 2u);
  EXPECT_EQ(seen.stretches()[0].low_m, 0);
  EXPECT_EQ(seen.stretches()[0].high_m, 3);
  EXPECT_EQ(seen.stretches()[1].low_m, 5);
}

TEST(Coverage, GapIsTheDistanceToTheNearestStretch) {
  Coverage seen;
  EXPECT_TRUE(std::isinf(seen.gap_m({0, 1})));
  seen.add({0, 1}, 0);
  seen.add({4, 5}, 0);
  EXPECT_EQ(seen.gap_m({1.5, 2}), 0.5);
  EXPECT_EQ(seen.gap_m({2.5, 3.75}), 0.25);
  EXPECT_EQ(seen.gap_m({0.5, 0.6}), 0);
}

TEST(Coverage, WhenItIsFullTheNearestTwoBecomeOne) {
  Coverage seen;
  for (int i = 0; i < 8; ++i) seen.add({10.0 * i, 10.0 * i + (i == 4 ? 6 : 1)}, 0);
  seen.add({100, 101}, 0);
  ASSERT_EQ(seen.stretches().size(), 8u);
  EXPECT_EQ(seen.stretches()[4].low_m, 40);
  EXPECT_EQ(seen.stretches()[4].high_m, 51);
  EXPECT_EQ(seen.stretches()[7].low_m, 100);
}

}  // namespace
}  // namespace waitpoint::segloc
