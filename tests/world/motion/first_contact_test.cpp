// SPDX-License-Identifier: BSD-3-Clause
#include "world/motion/first_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

Mover on_arc(const Shape& shape, const Arc& arc) { return Mover(shape, outline_of(shape, arc.start), arc); }

double gap(const Mover& a, const Mover& b, double fraction) {
  return separation(a.at(fraction), b.at(fraction)).distance_m;
}

TEST(FirstContact, StopsAMicrometreBeforeTheWallAtAnySpeed) {
  const Shape disc = cylinder({0, 0}, 0.25), square = box({0, 0, 0}, 0.5, 0.5);
  for (const Shape& body : {disc, square}) {
    for (const double distance : {0.001, 0.1, 10.0, 1e4}) {
      const Mover wall(outline_of(box({0.7505, 0, 0}, 0.001, 5)));  // its near face at 0.75 m
      const Mover mover = on_arc(body, {{0, 0, 0}, distance + 0.5, 0});
      const auto contact = first_contact(mover, wall, 0);
      ASSERT_TRUE(contact);
      EXPECT_TRUE(contact->first_closes);
      EXPECT_FALSE(contact->second_closes);
      EXPECT_NEAR(gap(mover, wall, contact->fraction), contact_gap_m, 2 * contact_tolerance_m);
      EXPECT_NEAR(contact->fraction * (distance + 0.5), 0.5 - contact_gap_m, 1e-8);
    }
  }
}

TEST(FirstContact, NoneWhereTheMotionEndsBeforeOrPasses) {
  const Shape disc = cylinder({0, 0}, 0.25);
  const Mover wall(outline_of(box({1, 0, 0}, 0.5, 0.5)));
  EXPECT_FALSE(first_contact(on_arc(disc, {{0, 0, 0}, 0.5 - 2e-6, 0}), wall, 0));
  EXPECT_TRUE(first_contact(on_arc(disc, {{0, 0, 0}, 0.5, 0}), wall, 0));
  EXPECT_FALSE(first_contact(on_arc(disc, {{0, 0.5 + 1e-5, 0}, 100, 0}), wall, 0));
  EXPECT_TRUE(first_contact(on_arc(disc, {{0, 0.5 - 1e-5, 0}, 100, 0}), wall, 0));
  EXPECT_FALSE(first_contact(on_arc(disc, {{0, 0, 0}, 0, 3}), wall, 0));
}

TEST(FirstContact, ATurningBoxStopsWhereItsCornerMeetsTheWall) {
  // A box of 0.8 m x 0.4 m turns about its centre, the wall 0.42 m in front: its corner reaches furthest to the front
  // at an angle where 0.4 cos a + 0.2 sin a = 0.42.
  const Shape body = box({0, 0, 0}, 0.8, 0.4);
  const Mover wall(outline_of(box({1.42, 0, 0}, 2, 6)));
  const Mover mover = on_arc(body, {{0, 0, 0}, 0, 1});
  const auto contact = first_contact(mover, wall, 0);
  ASSERT_TRUE(contact);
  const double reach = std::hypot(0.4, 0.2), at = std::atan2(0.2, 0.4) - std::acos(0.42 / reach);
  EXPECT_NEAR(contact->fraction, at, 1e-4);
  EXPECT_NEAR(gap(mover, wall, contact->fraction), contact_gap_m, 2 * contact_tolerance_m);
}

TEST(FirstContact, APrismStopsWhereItsNoseMeetsTheWallAtAnySpeed) {
  // A hull with its nose 0.5 m ahead and 0.1 m to the left.
  const Shape body = prism({0.1, 0.05, 0}, {{0.4, 0.05}, {0.1, 0.3}, {-0.4, 0.2}, {-0.4, -0.2}, {0.1, -0.3}});
  for (const double distance : {0.001, 0.1, 10.0, 1e4}) {
    for (const double slope : {0.0, 0.3, -0.2}) {  // of a wall that passes through (1, 0.1)
      const auto [s, c] = exact::sincos(slope);
      const Mover wall(outline_of(box({1 + 0.05 * c - 0.4 * s, 0.1 + 0.05 * s + 0.4 * c, slope}, 0.1, 5)));
      const Mover mover = on_arc(body, {{0, 0, 0}, distance + 0.5, 0});
      const auto contact = first_contact(mover, wall, 0);
      ASSERT_TRUE(contact);
      EXPECT_TRUE(contact->first_closes);
      EXPECT_NEAR(gap(mover, wall, contact->fraction), contact_gap_m, 2 * contact_tolerance_m);
      EXPECT_NEAR(contact->fraction * (distance + 0.5), 0.5 - contact_gap_m / c, 1e-8);
    }
  }
}

TEST(FirstContact, ATurningPrismStopsWhereItsCornerMeetsTheWall) {
  // Its corners are on a circle of 0.5 m; the foremost one is 0.3 rad past its point nearest to the wall.
  for (const int count : {3, 5, 16, 64}) {
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) {
      const auto [s, c] = exact::sincos(exact::wrap_angle(-0.3 / count + 2 * exact::pi * i / count));
      points.push_back({0.5 * c, 0.5 * s});
    }
    const Shape body = prism({0, 0, 0}, points);
    const double near_m = 0.5 * std::cos(0.1 / count);
    const Mover wall(outline_of(box({near_m + 1, 0, 0}, 2, 6)));
    const Mover mover = on_arc(body, {{0, 0, 0}, 0, 1});
    const auto contact = first_contact(mover, wall, 0);
    ASSERT_TRUE(contact) << count;
    const double at = 0.3 / count - std::acos((near_m - contact_gap_m) / 0.5);
    EXPECT_NEAR(0.5 * std::cos(0.3 / count - contact->fraction), near_m - contact_gap_m, 2 * contact_tolerance_m);
    EXPECT_NEAR(contact->fraction, at, 1e-6);
  }
}

TEST(FirstContact, APrismMeetsADiscWithItsCornerOrSideAndACornerWithItsSide) {
  const Shape body = prism({0, 0, 0}, {{0.5, 0}, {0, 0.4}, {-0.3, 0}, {0, -0.4}});
  const Mover mover = on_arc(body, {{0, 0, 0}, 3, 0});
  const auto with_corner_of_ours = first_contact(mover, Mover(outline_of(cylinder({2, 0.1}, 0.3))), 0);
  ASSERT_TRUE(with_corner_of_ours);
  EXPECT_NEAR(3 * with_corner_of_ours->fraction, 1.5 - std::sqrt(std::pow(0.3 + contact_gap_m, 2) - 0.01), 1e-8);
  // The foremost side has the normal (4, 5) / sqrt(41), and is 2 / sqrt(41) beyond the body's middle.
  const double root_41 = std::sqrt(41.0);
  const auto with_disc = first_contact(mover, Mover(outline_of(cylinder({2, 0.3}, 0.3))), 0);
  ASSERT_TRUE(with_disc);
  const double to_disc = 2 + 0.3 * 5 / 4 - (0.3 + contact_gap_m + 2 / root_41) * root_41 / 4;
  EXPECT_NEAR(3 * with_disc->fraction, to_disc, 1e-8);
  const Shape other = prism({2, 0.2, 0}, {{-0.4, 0}, {0.2, 0.3}, {0.2, -0.3}});
  const auto with_corner = first_contact(mover, Mover(outline_of(other)), 0);
  ASSERT_TRUE(with_corner);
  EXPECT_NEAR(3 * with_corner->fraction, 1.6 - 0.5 + 0.2 * 5 / 4 - contact_gap_m * root_41 / 4, 1e-8);
}

// With d ahead, s to the left and a turn of a, the centre moves about (-s, d) / a, from the angle -atan2(d, s) on.
TEST(FirstContact, SidewaysArcsMeetTheWallWhereTheirCircleDoes) {
  const Shape disc = cylinder({0, 0}, 0.25);
  const Mover wall(outline_of(box({1.1505, 0, 0}, 0.001, 50)));  // its near face at 1.15 m
  for (const double scale : {1.0, 10.0, 1000.0}) {
    for (const double side : {1.0, -0.7}) {
      const double d = 3, a = 2, radius = std::hypot(d, side) / a;
      const Mover mover = on_arc(disc, {{0, 0, 0}, scale * d, scale * a, scale * side});
      const auto contact = first_contact(mover, wall, 0);
      ASSERT_TRUE(contact);
      const double there = std::atan2(d, side) - std::acos((0.9 - contact_gap_m + side / a) / radius);
      EXPECT_NEAR(contact->fraction * scale * a, there, 1e-8);
      EXPECT_NEAR(gap(mover, wall, contact->fraction), contact_gap_m, 2 * contact_tolerance_m);
    }
  }
}

TEST(FirstContact, NeverLateOnRandomSidewaysArcs) {
  Draws draw(6);
  int contacts = 0;
  const auto arc = [&](double scale) {
    return Arc{{draw(-2, 2), draw(-2, 2), draw(-3, 3)}, scale * draw(-2, 2), scale * draw(-2, 2), scale * draw(-2, 2)};
  };
  for (int i = 0; i < 10000; ++i) {
    const Shape a = random_shape(draw, 0.2, 1), b = random_shape(draw, 0.2, 1);
    const double scale = i % 2 == 0 ? 1 : 20;
    const Mover first = on_arc(a, arc(scale)), second = on_arc(b, arc(scale));
    if (gap(first, second, 0) < 2 * contact_gap_m) continue;
    const auto contact = first_contact(first, second, 0);
    const double end = contact ? contact->fraction : 1;
    for (int k = 0; k <= 60; ++k) ASSERT_GT(gap(first, second, end * k / 60), 0.49 * contact_gap_m);
    contacts += contact ? 1 : 0;
    ASSERT_LT(contact ? gap(first, second, end) : 0, contact_gap_m + 2 * contact_tolerance_m);
  }
  EXPECT_GT(contacts, 1500);
}

TEST(FirstContact, InContactOnlyClosingIsRefused) {
  const Shape disc = cylinder({0, 0}, 0.25);
  const Mover wall(outline_of(box({1, 0, 0}, 0.5, 6)));
  const double x = 0.5 - contact_gap_m;
  const auto contact_at = [&](double heading, double distance, double turn) {
    return first_contact(on_arc(disc, {{x, 0, heading}, distance, turn}), wall, 0);
  };
  for (const double heading : {0.0, 0.5, -1.2, 1.57}) {
    const auto contact = contact_at(heading, 0.01, 0);
    ASSERT_TRUE(contact) << heading;
    EXPECT_EQ(contact->fraction, 0);
    EXPECT_FALSE(contact_at(heading, -0.01, 0)) << "backwards opens the gap";
  }
  EXPECT_FALSE(contact_at(0.3, 0, 1)) << "a disc turns freely";
  const Mover along = on_arc(disc, {{x, 0, 0.5 * exact::pi}, 2, 0});
  EXPECT_FALSE(first_contact(along, wall, 0)) << "sliding along the wall";
  const auto curved = contact_at(0.5 * exact::pi, 0.5, -0.5);
  ASSERT_TRUE(curved) << "a curve into the wall";
  EXPECT_LT(curved->fraction, 0.02);
  EXPECT_FALSE(contact_at(0.5 * exact::pi, 0.5, 0.5)) << "a curve away from the wall";
}

TEST(FirstContact, PushingForAYearDoesNotPenetrateTheWall) {
  const Shape body = box({0.1, 0, 0}, 0.6, 0.4);
  const Mover wall(outline_of(box({1, 0, 0.3}, 0.5, 6)));
  Draws draw(4);
  Pose pose = {0, 0, 0};
  double least = 1;
  for (int step = 0; step < 20000; ++step) {
    const Arc arc = {pose, draw(-0.002, 0.004), draw(-0.01, 0.01)};
    const Mover mover = on_arc(body, arc);
    const auto contact = first_contact(mover, wall, 0);
    pose = (contact ? arc.until(contact->fraction) : arc).end();
    least = std::min(least, separation(outline_of(body, pose), wall.start()).distance_m);
  }
  EXPECT_LT(least, 1.1 * contact_gap_m) << "it did push";
  EXPECT_GT(least, 0.49 * contact_gap_m);
}

TEST(FirstContact, NeverLateOnRandomArcs) {
  Draws draw(5);
  int contacts = 0;
  for (int i = 0; i < 20000; ++i) {
    Shape a = random_shape(draw, 0.2, 1), b = random_shape(draw, 0.2, 1);
    const double scale = i % 2 == 0 ? 1 : 20;
    const Mover first = on_arc(a, {{draw(-2, 2), draw(-2, 2), draw(-3, 3)}, scale * draw(-2, 2), scale * draw(-2, 2)});
    const Mover second = on_arc(b, {{draw(-2, 2), draw(-2, 2), draw(-3, 3)}, scale * draw(-2, 2), scale * draw(-2, 2)});
    if (gap(first, second, 0) < 2 * contact_gap_m) continue;
    const auto contact = first_contact(first, second, 0);
    const double end = contact ? contact->fraction : 1;
    for (int k = 0; k <= 60; ++k) ASSERT_GT(gap(first, second, end * k / 60), 0.49 * contact_gap_m);
    if (!contact) continue;
    ++contacts;
    ASSERT_LT(gap(first, second, end), contact_gap_m + 2 * contact_tolerance_m);
    ASSERT_LT(gap(first, second, std::min(1.0, end + 1e-6 / scale)), gap(first, second, end))
        << "it would have touched";
  }
  EXPECT_GT(contacts, 3000);
}

}  // namespace
}  // namespace waitpoint::world
