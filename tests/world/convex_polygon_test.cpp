// SPDX-License-Identifier: BSD-3-Clause
#include "world/convex_polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

double farthest_beyond_m(const PlacedPolygon& hull, const std::vector<Point>& points) {
  double most = -HUGE_VAL;
  for (const Point& p : points)
    for (const ConvexPolygon::Side& side : hull.polygon->sides())
      most = std::max(most, dot(side.outward, p - hull.origin) - side.beyond_m);
  return most;
}

std::vector<Point> corners(const PlacedPolygon& hull) {
  std::vector<Point> all;
  for (const ConvexPolygon::Side& side : hull.polygon->sides()) all.push_back(hull.origin + side.start);
  return all;
}

double area_m2(const PlacedPolygon& hull) {
  const std::vector<Point> c = corners(hull);
  double twice = 0;
  for (std::size_t i = 0; i < c.size(); ++i) twice += cross(c[i], c[(i + 1) % c.size()]);
  return 0.5 * twice;
}

std::vector<Point> circle(std::size_t count, double radius_m) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [s, c] =
        exact::sincos(exact::wrap_angle(2 * exact::pi * static_cast<double>(i) / static_cast<double>(count)));
    points.push_back({3 + radius_m * c, -2 + radius_m * s});
  }
  return points;
}

TEST(ConvexPolygon, HoldsAllPointsAndHasNoOtherCorners) {
  Draws draw(1);
  for (int round = 0; round < 2000; ++round) {
    std::vector<Point> points;
    for (std::uint64_t i = 3 + draw.below(60); i > 0; --i) points.push_back({draw(-2, 5), draw(-1, 1)});
    // Duplicates, and a collinear point.
    for (int i = 0; i < 3; ++i) points.push_back(points[draw.below(points.size())]);
    points.push_back(0.5 * (points[0] + points[1]));
    const auto hull = hull_of(points, 0);
    ASSERT_TRUE(hull);
    EXPECT_LT(farthest_beyond_m(*hull, points), 1e-8);
    const std::vector<Point> c = corners(*hull);
    for (std::size_t i = 0; i < c.size(); ++i) {
      EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](Point p) { return length(p - c[i]) < 1e-12; }));
      EXPECT_GT(cross(c[(i + 1) % c.size()] - c[i], c[(i + 2) % c.size()] - c[i]), 0) << "counter-clockwise";
    }
  }
}

TEST(ConvexPolygon, BoxHasFourCornersAboutItsCentre) {
  std::vector<Point> points;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) points.push_back(transform({1, 2, 0.3}, {0.1 * i, 0.05 * j}));
  const auto hull = hull_of(points, 1e-4);
  ASSERT_TRUE(hull);
  EXPECT_EQ(hull->polygon->sides().size(), 4u);
  EXPECT_NEAR(area_m2(*hull), 0.5, 1e-9);
  EXPECT_NEAR(length(hull->origin - transform({1, 2, 0.3}, {0.5, 0.25})), 0, 1e-12);
  EXPECT_NEAR(hull->polygon->mean_square_m2(), (1 + 0.25) / 12, 1e-9);
}

TEST(ConvexPolygon, ManyCornersAreEnclosedByFewer) {
  for (const std::size_t count :
       {ConvexPolygon::corners_max, ConvexPolygon::corners_max + 1, std::size_t{360}, std::size_t{5000}}) {
    const std::vector<Point> points = circle(count, 0.25);
    const auto hull = hull_of(points, 1e-4);
    ASSERT_TRUE(hull);
    EXPECT_EQ(hull->polygon->sides().size(), ConvexPolygon::corners_max);
    EXPECT_LT(farthest_beyond_m(*hull, points), 1e-8) << "it never becomes smaller";
    for (const Point c : corners(*hull)) EXPECT_LT(length(c - Point{3, -2}), 0.2515) << count;
  }
}

TEST(ConvexPolygon, CollinearPointsGiveNone) {
  EXPECT_FALSE(hull_of({}, 0));
  EXPECT_FALSE(hull_of({{1, 1}}, 0));
  EXPECT_FALSE(hull_of({{1, 1}, {2, 3}, {3, 5}, {1, 1}}, 0));
  const std::vector<Point> strip = {{0, 0}, {5, 5}, {4.9999, 5.0001}};
  EXPECT_FALSE(hull_of(strip, 1e-3));
  EXPECT_TRUE(hull_of(strip, 1e-5));
}

}  // namespace
}  // namespace waitpoint::world
