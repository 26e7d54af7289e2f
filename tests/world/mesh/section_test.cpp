// SPDX-License-Identifier: BSD-3-Clause
// Sections of triangles at a height, and their parts between two heights.
#include "world/mesh/section.hpp"

#include <gtest/gtest.h>

#include "tests/world/meshes.hpp"
#include "world/mesh/surfaces.hpp"
#include "world/planar/ray.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::world {
namespace {

constexpr Triangle upright = {{{{0, 0, 0}, {4, 0, 0}, {0, 0, 2}}}};
constexpr Triangle tilted = {{{{0, 0, 0}, {4, 0, 0}, {0, 4, 4}}}};

TEST(Cut, IsTheSegmentAtThatHeight) {
  const std::optional<Outline> segment = cut(upright, 1);
  ASSERT_TRUE(segment.has_value());
  EXPECT_EQ(segment->centre, (Point{1, 0}));
  EXPECT_EQ(segment->half_length_m, 1);
  EXPECT_EQ(segment->half_width_m, 0);
  EXPECT_TRUE(segment->is_box);
  EXPECT_FALSE(cut(upright, 2.1).has_value());
  EXPECT_FALSE(cut(upright, -0.1).has_value());
}

TEST(Cut, CountsACornerAtItsHeightAsAbove) {
  EXPECT_FALSE(cut(upright, 0).has_value()) << "it stands on the height";
  EXPECT_FALSE(cut(upright, 2).has_value()) << "a point, not a segment";
  const Triangle hanging = {{{{0, 0, 2}, {4, 0, 2}, {0, 0, 0}}}};
  ASSERT_TRUE(cut(hanging, 2).has_value()) << "its upper side";
  EXPECT_EQ(cut(hanging, 2)->half_length_m, 2);
  const Triangle level = {{{{0, 0, 2}, {4, 0, 2}, {0, 4, 2}}}};
  EXPECT_FALSE(cut(level, 2).has_value());
}

TEST(Cut, ClosedSurfaceStopsEveryBeam) {
  Draws draw(1);
  long beams = 0;
  for (int k = 0; k < 20; ++k) {
    const TriangleMesh ball = lumpy_ball(draw, 3, 5);
    const MeshObstacle obstacle = mesh_obstacle("ball", ball);
    const Surfaces surfaces({&obstacle, 1});
    for (int cut_number = 0; cut_number < 10; ++cut_number) {
      // Half of the heights are those of corners.
      double height_m = draw(-2, 2);
      if (cut_number == 0) height_m = 0;
      while (cut_number > 0 && cut_number % 2 == 0) {
        height_m = ball.corners[draw.below(ball.corners.size())].z;
        if (std::fabs(height_m) < 2) break;
      }
      const Surfaces::Cut all = surfaces.cut(height_m);
      for (int i = 0; i < 500; ++i, ++beams) {
        Ray ray = {{draw(-0.5, 0.5), draw(-0.5, 0.5)}, {}};
        Point target = {draw(-5, 5), draw(-5, 5)};
        // Half of the beams aim at common ends of two segments.
        if (i % 2 == 0) target = core_points(all.segments[draw.below(all.segments.size())])[i % 4];
        ray.direction = (1 / length(target - ray.origin)) * (target - ray.origin);
        double range_m = no_hit;
        for (const Outline& segment : all.segments) range_m = std::min(range_m, hit_distance(segment, ray));
        ASSERT_LT(range_m, 6.5) << "height " << height_m;
        ASSERT_GT(range_m, 2);
      }
    }
  }
  EXPECT_EQ(beams, 100'000);
}

TEST(Cover, IsWhatLiesBetweenTheHeights) {
  std::vector<Outline> pieces;
  cover(tilted, 1, 2, pieces);
  // A trapezium: y from 1 to 2, x from 0 to 4 - y.
  const auto covers = [&](Point p) {
    return std::any_of(pieces.begin(), pieces.end(), [&](const Outline& piece) {
      return separation(outline_of(cylinder(p, 1e-9)), piece).distance_m < 0;
    });
  };
  EXPECT_TRUE(covers({0.01, 1.01}));
  EXPECT_TRUE(covers({2.98, 1.01}));
  EXPECT_TRUE(covers({1.98, 1.99}));
  EXPECT_FALSE(covers({3.02, 1.01}));
  EXPECT_FALSE(covers({1, 0.99}));
  EXPECT_FALSE(covers({1, 2.01}));
  EXPECT_FALSE(covers({-0.01, 1.5}));
}

TEST(Cover, TouchingTheHeightsGivesNothing) {
  std::vector<Outline> pieces;
  cover(upright, 2, 3, pieces);
  cover(upright, -1, 0, pieces);
  const Triangle level = {{{{0, 0, 2}, {4, 0, 2}, {0, 4, 2}}}};
  cover(level, 2, 3, pieces);
  cover(level, 1, 2, pieces);
  EXPECT_TRUE(pieces.empty());
  cover(level, 1, 3, pieces);
  EXPECT_EQ(pieces.size(), 1u);
}

TEST(Triangles, HaveTheDistanceOfTheirNearestPoints) {
  Draws draw(2);
  for (int k = 0; k < 20'000; ++k) {
    const Point a = {draw(-2, 2), draw(-2, 2)}, b = {draw(-2, 2), draw(-2, 2)};
    const double t = draw(0, 1);
    const Point c = k % 3 == 0 ? a + t * (b - a) : Point{draw(-2, 2), draw(-2, 2)};
    const Shape shape = random_shape(draw, 3, 2);
    const Outline triangle = triangle_outline(a, b, c), other = outline_of(shape);
    const Separation s = separation(triangle, other);
    EXPECT_NEAR(s.distance_m, separation(other, triangle).distance_m, 1e-12);
    EXPECT_NEAR(length(s.normal), 1, 1e-12);
    // No two points of them are nearer than this distance, and some are about that near.
    double nearest = HUGE_VAL;
    for (int i = 0; i <= 40; ++i) {
      for (int j = 0; i + j <= 40; ++j) {
        const double u = i / 40.0, v = j / 40.0;
        const Point p = a + u * (b - a) + v * (c - a);
        nearest = std::min(nearest, separation(outline_of(cylinder(p, 1e-12)), other).distance_m);
      }
    }
    EXPECT_GE(nearest, std::min(s.distance_m, 0.0) - 3);
    if (s.distance_m > 0) {
      EXPECT_GE(nearest, s.distance_m - 1e-9) << k;
      EXPECT_LE(nearest, s.distance_m + 0.12) << k;
    }
    if (nearest < 0) {
      EXPECT_LE(s.distance_m, 1e-9) << k;
    }
    // Moved apart by that much along the normal, they only just touch.
    if (s.distance_m < 0) {
      const Point slide = (s.distance_m - 1e-7) * s.normal;
      const Outline moved = triangle_outline(a + slide, b + slide, c + slide);
      EXPECT_NEAR(separation(moved, other).distance_m, 1e-7, 1e-9) << k;
    }
  }
}

// A triangle clipped at its tip may round to one point.
TEST(Cover, PieceOfOnePointIsAsFarAsThePoint) {
  const Outline body = outline_of(prism({0, 0, 0}, {{-1, -1}, {1, -1}, {0, 1}}));
  const Separation s = separation(body, triangle_outline({0, -3}, {0, -3}, {0, -3}));
  EXPECT_NEAR(s.distance_m, separation(body, outline_of(cylinder({0, -3}, 1e-12))).distance_m, 1e-9);
}

}  // namespace
}  // namespace waitpoint::world
