// SPDX-License-Identifier: BSD-3-Clause
// Neighbours and collisions by footprints against FCL's trees and FCL's own narrow phase.
#include "world/slice/footprints.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/scenes.hpp"
#include "world/fcl/scene.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::world {
namespace {

constexpr double floor_half_m = 12;

TEST(Footprints, NearAreThoseOfTheSceneToTheLastBit) {
  for (const double offset_m : {0.0, 1e6}) {
    std::vector<Shape> shapes = random_shapes(1, 300, floor_half_m);
    for (Shape& shape : shapes) shape.pose.x += offset_m;
    const Scene scene(shapes);
    for (const Kernels* variant : all_kernels()) {
      const Footprints footprints(shapes, *variant);
      Draws draw(2);
      std::vector<std::uint32_t> expected, found;
      std::size_t most = 0;
      for (int k = 0; k < 2000; ++k) {
        const Point low = {offset_m + draw(-20, 18), draw(-20, 18)};
        Bounds bounds = {low, {low.x + draw(0, 3), low.y + draw(0, 3)}};
        // Some end where a solid begins, up to rounding.
        if (k % 3 == 0) {
          const auto solid = static_cast<std::uint32_t>(draw.below(scene.size()));
          bounds.high.x = bounds_of(scene.outline(solid)).low.x - Scene::padding_m + (k % 2 == 0 ? 1e-16 : -1e-16);
          bounds.low.x = bounds.high.x - 1;
        }
        const double z_low_m = draw(0, 1), z_high_m = z_low_m + draw(0, 0.3);
        scene.near(bounds, z_low_m, z_high_m, expected);
        footprints.near(bounds, Scene::padding_m, z_low_m, z_high_m, found);
        ASSERT_EQ(found, expected) << k;
        most = std::max(most, found.size());
      }
      EXPECT_GT(most, 5u);
    }
  }
}

TEST(Footprints, CollideWhereFclDoesOnAMillionPlacements) {
  constexpr double half_m = 5;
  int apart = 0, together = 0;
  for (std::uint64_t scene_number = 0; scene_number < 50; ++scene_number) {
    const std::vector<Shape> shapes = random_shapes(100 + scene_number, 10, half_m);
    const Scene scene(shapes);
    const Footprints footprints(shapes);
    Draws draw(1000 + scene_number);
    for (int k = 0; k < 20'000; ++k) {
      Shape probe = random_shape(draw, half_m, 1.2);
      probe.z_low_m = k % 4 == 0 ? draw(0, 0.6) : 0;
      probe.z_high_m = probe.z_low_m + draw(0.1, 0.5);
      const Outline outline = outline_of(probe);
      double nearest = HUGE_VAL;
      for (const Shape& shape : shapes)
        if (heights_overlap(shape, probe))
          nearest = std::min(nearest, separation(outline, outline_of(shape)).distance_m);
      ASSERT_EQ(footprints.collides(outline, probe.z_low_m, probe.z_high_m), nearest < 0) << scene_number << " " << k;
      if (std::fabs(nearest) < 1e-6) continue;
      ASSERT_EQ(scene.collides(probe), nearest < 0) << scene_number << " " << k << ": " << nearest;
      ++(nearest < 0 ? together : apart);
    }
  }
  EXPECT_GT(apart, 100'000);
  EXPECT_GT(together, 100'000);
}

TEST(Footprints, EmptySetHasNothingNear) {
  const Footprints footprints({});
  std::vector<std::uint32_t> found = {7};
  footprints.near({{-1, -1}, {1, 1}}, 0, 0, 1, found);
  EXPECT_TRUE(found.empty());
  EXPECT_FALSE(footprints.collides(outline_of(cylinder({0, 0}, 1)), 0, 1));
}

}  // namespace
}  // namespace waitpoint::world
