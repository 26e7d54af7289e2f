// SPDX-License-Identifier: BSD-3-Clause
#include "modules/rflex/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace waitpoint::rflex {
namespace {

posters::PositionEstimate reckoned(double heading, std::int64_t travel, std::int64_t turn, std::int64_t side) {
  DeadReckoning reckoning({}, 1000, 1000);
  reckoning.set({2, 3, heading});
  reckoning.advance(Time(), 0, 0, 0);
  for (int i = 1; i <= 50; ++i) reckoning.advance(Time(), i * travel, i * turn, i * side);
  return reckoning.position();
}

// Motion to the left equals motion ahead with a heading turned by 90 degrees: the same place, the same uncertainty.
TEST(DeadReckoning, SidewaysIsAheadSeenFromAQuarterTurn) {
  for (const std::int64_t turn : {0, 30}) {
    const posters::PositionEstimate aside = reckoned(0.3, 0, turn, 40);
    const posters::PositionEstimate ahead = reckoned(0.3 + 0.5 * exact::pi, 40, turn, 0);
    EXPECT_NEAR(length(aside.pose.position() - ahead.pose.position()), 0, 1e-12);
    for (std::size_t i = 0; i < aside.covariance.size(); ++i)
      EXPECT_NEAR(aside.covariance[i], ahead.covariance[i], 1e-15) << i;
    EXPECT_GT(aside.covariance[0], 0);
  }
}

TEST(DeadReckoning, DiagonallyTheUncertaintiesOfBothWaysAdd) {
  const posters::PositionEstimate both = reckoned(0, 30, 0, 40);
  EXPECT_NEAR(both.pose.x, 2 + 1.5, 1e-12);
  EXPECT_NEAR(both.pose.y, 3 + 2, 1e-12);
  const OdometryNoise noise;
  EXPECT_NEAR(both.covariance[8], noise.turn_variance_rad2_per_m * 3.5, 1e-15);
}

}  // namespace
}  // namespace waitpoint::rflex
