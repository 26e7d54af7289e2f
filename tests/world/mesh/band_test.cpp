// SPDX-License-Identifier: BSD-3-Clause
// A band's precomputed parts against the surfaces, which clip every triangle anew, and against FCL's narrow phase.
#include "world/mesh/band.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/world/meshes.hpp"
#include "world/fcl/mesh_tree.hpp"

namespace waitpoint::world {
namespace {

TEST(Band, DistancesAreThoseOfTheSurfacesToTheLastBit) {
  Draws draw(11);
  for (int scene = 0; scene < 20; ++scene) {
    const MeshObstacle mesh = mesh_obstacle("mesh", random_triangles(draw, 60, 4, 1.2, 2));
    const Surfaces surfaces({&mesh, 1});
    const double z_low_m = draw(0, 1.5), z_high_m = z_low_m + draw(0.1, 0.6);
    const Band band(surfaces, z_low_m, z_high_m);
    for (int k = 0; k < 50; ++k) {
      const Shape shape = random_shape(draw, 4, 0.8);
      const Outline body = outline_of(shape);
      for (std::uint32_t i = 0; i < surfaces.size(); ++i)
        ASSERT_EQ(band.separation_m(body, i), surfaces.separation(body, z_low_m, z_high_m, i).distance_m) << i;
    }
  }
}

TEST(Band, NearAreAllWithinReachAndNoneFarAway) {
  Draws draw(12);
  const MeshObstacle mesh = mesh_obstacle("mesh", random_triangles(draw, 500, 20, 2, 2));
  const Surfaces surfaces({&mesh, 1});
  const Band band(surfaces, 0.5, 0.9);
  std::vector<std::uint32_t> found, whole;
  std::size_t count = 0, of_whole = 0;
  for (int k = 0; k < 500; ++k) {
    const Shape shape = random_shape(draw, 20, 1);
    const Outline body = outline_of(shape);
    const double reach_m = draw(0, 1);
    band.near(bounds_of(body).grown(reach_m), found);
    surfaces.near(bounds_of(body).grown(reach_m + 1e-3), 0.5, 0.9, whole);
    ASSERT_TRUE(std::includes(whole.begin(), whole.end(), found.begin(), found.end()));
    for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
      const bool is_found = std::binary_search(found.begin(), found.end(), i);
      ASSERT_TRUE(is_found || band.separation_m(body, i) > reach_m) << k << " " << i;
    }
    count += found.size();
    of_whole += whole.size();
  }
  // The parts are smaller than the triangles.
  EXPECT_LT(static_cast<double>(count), 0.8 * static_cast<double>(of_whole));
}

// Radii about the distance of the nearest part: rounding would decide, if distances were not those of separation().
TEST(Band, DiscsThatJustTouchCollideAsSeparationSays) {
  Draws draw(13);
  long together = 0, apart = 0;
  for (int scene = 0; scene < 10; ++scene) {
    const MeshObstacle mesh = mesh_obstacle("mesh", random_triangles(draw, 40, 3, 1.2, 2));
    const Surfaces surfaces({&mesh, 1});
    const Band band(surfaces, 0.2, 0.8);
    for (int k = 0; k < 100; ++k) {
      Outline disc;
      disc.centre = {draw(-4, 4), draw(-4, 4)};
      const double distance_m = std::max(nearest_m(surfaces, disc, 0.2, 0.8), 0.0);
      for (const double more_m : {-1e-3, -1e-6, -1e-7, -1e-15, 0.0, 1e-15, 1e-7, 1e-6, 1e-3}) {
        disc.radius_m = std::max(distance_m + more_m, 0.0);
        const bool meets = nearest_m(surfaces, disc, 0.2, 0.8) < 0;
        ASSERT_EQ(band.collides(disc), meets) << scene << " " << k << " " << more_m;
        ++(meets ? together : apart);
      }
    }
  }
  EXPECT_GT(together, 3000);
  EXPECT_GT(apart, 3000);
}

TEST(Band, CollidesWhereFclDoesOnRandomPlacements) {
  Draws draw(14);
  long together = 0, apart = 0;
  for (int scene = 0; scene < 60; ++scene) {
    const MeshObstacle mesh = mesh_obstacle("mesh", random_triangles(draw, 16, 2.5, 1.2, 2));
    const Surfaces surfaces({&mesh, 1});
    const MeshTree tree({&mesh, 1});
    const double z_low_m = scene % 3 == 0 ? 0 : draw(0, 1.5), z_high_m = z_low_m + draw(0.1, 0.6);
    const Band band(surfaces, z_low_m, z_high_m), lower(surfaces, z_low_m + 1e-6, z_high_m - 1e-6),
        higher(surfaces, z_low_m - 1e-6, z_high_m + 1e-6);
    for (int k = 0; k < 300; ++k) {
      Shape probe = random_shape(draw, 2.5, 0.8);
      probe.z_low_m = z_low_m;
      probe.z_high_m = z_high_m;
      const Outline outline = outline_of(probe);
      const bool meets = band.collides(outline);
      // Skips placements in which a triangle only just touches, begins above or ends below.
      if (std::fabs(nearest_m(surfaces, outline, z_low_m, z_high_m)) < 1e-6 || lower.collides(outline) != meets ||
          higher.collides(outline) != meets)
        continue;
      ASSERT_EQ(tree.collides(probe), meets) << scene << " " << k;
      ++(meets ? together : apart);
    }
  }
  EXPECT_GT(together, 2000);
  EXPECT_GT(apart, 2000);
}

TEST(Band, WithoutSurfacesIsEmpty) {
  const Band band(Surfaces({}), 0, 1);
  std::vector<std::uint32_t> found = {1};
  band.near({{-1, -1}, {1, 1}}, found);
  EXPECT_TRUE(found.empty());
  Outline disc;
  disc.radius_m = 1;
  EXPECT_FALSE(band.collides(disc));
}

}  // namespace
}  // namespace waitpoint::world
