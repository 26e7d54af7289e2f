// SPDX-License-Identifier: BSD-3-Clause
#include "core/pose.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace waitpoint {
namespace {

using exact::pi;

void expect_near(const Pose& a, const Pose& b) {
  EXPECT_NEAR(a.x, b.x, 1e-13);
  EXPECT_NEAR(a.y, b.y, 1e-13);
  EXPECT_NEAR(exact::wrap_angle(a.heading - b.heading), 0, 1e-13);
}

TEST(Pose, ComposesInTheFrameOfTheFirst) {
  const Pose left_of_origin = compose({1, 2, pi / 2}, {3, 4, pi / 2});
  expect_near(left_of_origin, {1 - 4, 2 + 3, pi});
  const Point p = transform({1, 2, pi / 2}, {3, 4});
  EXPECT_NEAR(p.x, -3, 1e-15);
  EXPECT_NEAR(p.y, 5, 1e-15);
}

TEST(Pose, BetweenUndoesCompose) {
  const RandomStream random(1, "", "poses");
  const auto draw = [&](std::uint64_t i) { return 6 * random.uniform(i) - 3; };
  for (std::uint64_t i = 0; i < 6000; i += 6) {
    const Pose a = {draw(i), draw(i + 1), draw(i + 2)}, b = {draw(i + 3), draw(i + 4), draw(i + 5)};
    expect_near(compose(a, between(a, b)), b);
    expect_near(between(a, compose(a, b)), b);
  }
}

TEST(Pose, InterpolatesAlongTheShorterTurn) {
  const Pose a = {0, 0, 3}, b = {0, 0, -3};
  expect_near(interpolate(a, b, 0), a);
  expect_near(interpolate(a, b, 1), b);
  expect_near(interpolate(a, b, 0.5), {0, 0, pi});
}

}  // namespace
}  // namespace waitpoint
