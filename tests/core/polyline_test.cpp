// SPDX-License-Identifier: BSD-3-Clause
#include "core/polyline.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace waitpoint {
namespace {

using Indices = std::vector<std::size_t>;

TEST(Polyline, KeepsCornersAndLosesPointsOnTheLine) {
  const std::vector<Point> corner = {{0, 0}, {1, 0.001}, {2, 0}, {3, -0.001}, {4, 0}, {4, 3}};
  EXPECT_EQ(simplified(corner, 0.01), (Indices{0, 4, 5}));
  EXPECT_EQ(simplified(corner, 0.0001), (Indices{0, 1, 3, 4, 5})) << "(2, 0) lies on what remains";
}

TEST(Polyline, KeepsAPointBeyondTheEndsOfALine) {
  EXPECT_EQ(simplified(std::vector<Point>{{0, 0}, {5, 0}, {1, 0}}, 0.01), (Indices{0, 1, 2}));
}

TEST(Polyline, KeepsShortLinesAndNoPointWithoutAPlace) {
  EXPECT_EQ(simplified({}, 0.01), Indices{});
  EXPECT_EQ(simplified(std::vector<Point>{{0, 0}, {0, 0}}, 0.01), (Indices{0, 1}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(simplified(std::vector<Point>{{0, 0}, {nan, 0}, {2, 0}}, 0.01), (Indices{0, 2}));
}

}  // namespace
}  // namespace waitpoint
