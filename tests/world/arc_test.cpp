// SPDX-License-Identifier: BSD-3-Clause
#include "world/arc.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

void expect_near(const Pose& a, const Pose& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(exact::wrap_angle(a.heading - b.heading), 0, tolerance);
}

TEST(Arc, IsTheCircleThatConstantVelocityDrives) {
  Draws draw(1);
  for (int i = 0; i < 10000; ++i) {
    const Arc arc = {{draw(-50, 50), draw(-50, 50), draw(-3, 3)}, draw(-2, 2), draw(-6, 6)};
    const long double radius = static_cast<long double>(arc.distance_m) / arc.turn_rad;
    const long double from = arc.start.heading, to = from + arc.turn_rad;
    const Pose end = arc.end();
    const double tolerance = 1e-13 * (60 + std::fabs(static_cast<double>(radius)));
    EXPECT_NEAR(end.x, static_cast<double>(arc.start.x + radius * (sinl(to) - sinl(from))), tolerance);
    EXPECT_NEAR(end.y, static_cast<double>(arc.start.y - radius * (cosl(to) - cosl(from))), tolerance);
  }
}

TEST(Arc, HalvesMakeTheWhole) {
  Draws draw(2);
  for (int i = 0; i < 10000; ++i) {
    const double turn = draw(-3, 3) * (i % 3 == 0 ? 1e-9 : 1);
    const Arc whole = {{draw(-50, 50), draw(-50, 50), draw(-3, 3)}, draw(-2, 2), i % 5 == 0 ? 0 : turn};
    const double cut = draw(0, 1);
    const Arc first = whole.until(cut);
    const Arc second = {first.end(), (1 - cut) * whole.distance_m, (1 - cut) * whole.turn_rad};
    expect_near(second.end(), whole.end(), 1e-13);
    expect_near(whole.at(cut), first.end(), 1e-13);
  }
}

TEST(Arc, TurningOnTheSpotAndStandingStillMoveNothing) {
  const Pose start = {3.3, -4.7, 0.9};
  EXPECT_EQ((Arc{start, 0, 0}.end()), start);
  const Pose turned = Arc{start, 0, 1.1}.end();
  EXPECT_EQ(turned.position(), start.position());
  EXPECT_NEAR(turned.heading, 2.0, 1e-15);
}

// Sideways motion is motion along an x axis a quarter of a turn to the left.
TEST(Arc, SidewaysIsAheadSeenFromAQuarterTurn) {
  Draws draw(3);
  for (int i = 0; i < 10000; ++i) {
    const Pose start = {draw(-50, 50), draw(-50, 50), draw(-3, 3)};
    const double ahead = draw(-2, 2), aside = draw(-2, 2), turn = i % 4 == 0 ? 0 : draw(-6, 6);
    const Pose both = Arc{start, ahead, turn, aside}.end();
    const Pose turned = {start.x, start.y, start.heading + exact::pi / 2};
    const Pose one = Arc{start, ahead, turn}.end(), other = Arc{turned, aside, turn}.end();
    expect_near(both, {one.x + other.x - start.x, one.y + other.y - start.y, one.heading}, 1e-13);
  }
}

TEST(Arc, BetweenTwoPosesEndsWhereItShould) {
  Draws draw(4);
  for (int i = 0; i < 10000; ++i) {
    const Arc there = {{draw(-50, 50), draw(-50, 50), draw(-3, 3)},
                       draw(-2, 2),
                       i % 4 == 0 ? 0 : draw(-3, 3),
                       draw(-2, 2),
                       draw(-1, 1)};
    const Arc found =
        Arc::between(there.start, there.end().position() - there.start.position(), there.turn_rad, there.climb_m);
    EXPECT_NEAR(found.distance_m, there.distance_m, 1e-12);
    EXPECT_NEAR(found.side_m, there.side_m, 1e-12);
    expect_near(found.end(), there.end(), 1e-13);
    EXPECT_EQ(found.climb_m, there.climb_m);
  }
  EXPECT_FALSE(Arc::between({1, 2, 0.3}, {}, 0, 0).moves());
}

TEST(Arc, LengthsAreThoseOfTheOriginsPath) {
  const Arc arc = {{1, 2, 0.3}, -3, 1, 4, 12};
  EXPECT_EQ(arc.planar_length_m(), 5);
  EXPECT_EQ(arc.length_m(), 13);
  EXPECT_EQ((Arc{{1, 2, 0.3}, -3, 1}.length_m()), 3);
  EXPECT_EQ(arc.until(0.5).climb_m, 6);
}

TEST(Arc, AFullCircleComesBack) {
  const Arc circle = {{1, 2, 0.3}, 5, 2 * exact::pi};
  expect_near(circle.end(), circle.start, 1e-14);
}

}  // namespace
}  // namespace waitpoint::world
