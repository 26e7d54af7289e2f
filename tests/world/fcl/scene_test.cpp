// SPDX-License-Identifier: BSD-3-Clause
// The planar distance against FCL's own narrow phase: two independent implementations.
#include "world/fcl/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/world/scenes.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::world {
namespace {

TEST(Scene, FclCollidesWhereThePlanarDistanceIsNegative) {
  Draws draw(1);
  int apart = 0, together = 0;
  for (int scene_number = 0; scene_number < 1000; ++scene_number) {
    const Shape standing = random_shape(draw, 0.5, 2);
    const Scene scene({&standing, 1});
    for (int i = 0; i < 100; ++i) {
      Shape probe = random_shape(draw, 1.5, 2);
      // FCL (by libccd) reports a collision of two convex hulls with faces in one plane though they are centimetres
      // apart.
      if (standing.kind == Shape::Kind::prism && probe.kind == Shape::Kind::prism) probe.z_high_m = 0.9;
      if (standing.kind == Shape::Kind::prism && probe.kind == Shape::Kind::prism) probe.z_low_m = 0.1;
      const double distance = separation(outline_of(standing), outline_of(probe)).distance_m;
      if (std::fabs(distance) < 1e-6) continue;
      ASSERT_EQ(scene.collides(probe), distance < 0) << scene_number << " " << i << ": " << distance;
      ++(distance < 0 ? together : apart);
    }
  }
  EXPECT_GT(apart, 20000);
  EXPECT_GT(together, 20000);
}

TEST(Scene, CollidesOnlyWhereHeightsOverlap) {
  Shape table = box({0, 0, 0}, 1, 1), probe = box({0.2, 0.1, 0.4}, 0.5, 0.5);
  table.z_low_m = 0.7;
  table.z_high_m = 0.75;
  probe.z_high_m = 0.5;
  EXPECT_FALSE(Scene({&table, 1}).collides(probe));
  probe.z_high_m = 0.72;
  EXPECT_TRUE(Scene({&table, 1}).collides(probe));
}

TEST(Scene, NearFindsAllThatBoundsTouchInOrder) {
  Draws draw(2);
  std::vector<Shape> shapes;
  for (int i = 0; i < 300; ++i) shapes.push_back(random_shape(draw, 20, 2));
  const Scene scene(shapes);
  std::vector<std::uint32_t> found;
  for (int k = 0; k < 500; ++k) {
    const Point low = {draw(-20, 18), draw(-20, 18)};
    const Bounds bounds = {low, {low.x + draw(0, 4), low.y + draw(0, 4)}};
    scene.near(bounds, 0, 1, found);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    for (std::uint32_t i = 0; i < scene.size(); ++i) {
      const bool listed = std::binary_search(found.begin(), found.end(), i);
      if (bounds.overlaps(bounds_of(scene.outline(i)))) {
        EXPECT_TRUE(listed);
      }
      if (!bounds.grown(1e-6).overlaps(bounds_of(scene.outline(i)))) {
        EXPECT_FALSE(listed);
      }
    }
  }
  scene.near({{-20, -20}, {20, 20}}, 1, 2, found);
  EXPECT_TRUE(found.empty()) << "solids end where these heights begin";
}

TEST(Scene, AnEmptyOneIsEmpty) {
  const Scene scene({});
  std::vector<std::uint32_t> found = {7};
  scene.near({{-1, -1}, {1, 1}}, 0, 1, found);
  EXPECT_TRUE(found.empty());
  const Point direction = {1, 0};
  double range = 12;
  scene.cast({0, 0}, {&direction, 1}, 0.5, Scene::none, {&range, 1});
  EXPECT_EQ(range, 12);
  EXPECT_FALSE(scene.collides(box({0, 0, 0}, 1, 1)));
}

}  // namespace
}  // namespace waitpoint::world
