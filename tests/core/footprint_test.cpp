// SPDX-License-Identifier: BSD-3-Clause
#include "core/footprint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace waitpoint {
namespace {

// 0.8 m x 0.4 m, 0.1 m ahead of the origin.
const std::array<Point, 4> ahead = {{{0.5, 0.2}, {-0.3, 0.2}, {-0.3, -0.2}, {0.5, -0.2}}};

TEST(Footprint, PolygonHasTheReachOfItsHullInEachDirection) {
  const Footprint footprint(ahead, 0.6);
  EXPECT_FALSE(footprint.is_disc());
  EXPECT_NEAR(footprint.inner_radius_m(), 0.2, 1e-12);
  EXPECT_NEAR(footprint.reach_m({3, 0}), 0.5, 1e-12);
  EXPECT_NEAR(footprint.reach_m({-3, 0}), 0.3, 1e-12);
  EXPECT_NEAR(footprint.reach_m({0, -3}), 0.2, 1e-12);
  EXPECT_NEAR(footprint.reach_m({1, 1}), 0.2 * std::sqrt(2.0), 1e-12);
}

TEST(Footprint, MeasuresDistancesFromSidesAndCorners) {
  const Footprint footprint(ahead, 0.6);
  EXPECT_EQ(footprint.distance_m({0.4, 0.1}), 0);
  EXPECT_NEAR(footprint.distance_m({0.2, 0.5}), 0.3, 1e-12);
  EXPECT_NEAR(footprint.distance_m({0.8, 0.6}), 0.5, 1e-12);
  EXPECT_NEAR(Footprint(0.3).distance_m({0.3, 0.4}), 0.2, 1e-12);
}

TEST(Footprint, HullPointsIncludeTheCornersAndLeaveNoWiderGaps) {
  const std::vector<Point> points = Footprint(ahead, 0.6).hull_points(0.05);
  for (const Point corner : ahead) EXPECT_NE(std::find(points.begin(), points.end(), corner), points.end());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LE(length(points[(i + 1) % points.size()] - points[i]), 0.05 + 1e-12);
  EXPECT_TRUE(Footprint(0.3).hull_points(0.05).empty());
}

TEST(Footprint, IsTheDiscIfTheOriginIsNotInside) {
  std::array<Point, 4> beside = ahead;
  for (Point& corner : beside) corner.x += 1;
  EXPECT_TRUE(Footprint(beside, 2).is_disc());
  EXPECT_EQ(Footprint(beside, 2).inner_radius_m(), 2);
}

}  // namespace
}  // namespace waitpoint
