// SPDX-License-Identifier: BSD-3-Clause
// This world's geometry of meshes against FCL's own narrow phase, and both engines against each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/world/meshes.hpp"
#include "tests/world/placements.hpp"
#include "world/fcl/mesh_tree.hpp"
#include "world/kinematic/start_check.hpp"
#include "world/mesh/surfaces.hpp"

namespace waitpoint::world {
namespace {

TEST(Surfaces, CollideWhereFclDoesOnRandomPlacements) {
  Draws draw(1);
  constexpr int of_each_scene = 2000;
  const long wanted = placements(160'000);
  long apart = 0, together = 0;
  for (int scene = 0; apart + together < wanted; ++scene) {
    const MeshObstacle mesh = mesh_obstacle("mesh", random_triangles(draw, 16, 2.5, 1.2, 2));
    const Surfaces surfaces({&mesh, 1});
    const MeshTree tree({&mesh, 1});
    for (int k = 0; k < of_each_scene; ++k) {
      Shape probe = random_shape(draw, 2.5, 0.8);
      probe.z_low_m = k % 3 == 0 ? draw(0, 1.5) : 0;
      probe.z_high_m = probe.z_low_m + draw(0.1, 0.6);
      const Outline outline = outline_of(probe);
      const double gap_m = nearest_m(surfaces, outline, probe.z_low_m, probe.z_high_m);
      // Skips placements in which a triangle only just begins above or ends below: slightly different heights change
      // the result.
      const double lower_m = nearest_m(surfaces, outline, probe.z_low_m + 1e-6, probe.z_high_m - 1e-6);
      const double higher_m = nearest_m(surfaces, outline, probe.z_low_m - 1e-6, probe.z_high_m + 1e-6);
      const bool meets = gap_m < 0;
      if (std::fabs(gap_m) < 1e-6 || (lower_m < 1e-6) != meets || (higher_m < 1e-6) != meets) continue;
      ASSERT_EQ(tree.collides(probe), meets) << scene << " " << k << ": " << gap_m;
      ++(meets ? together : apart);
    }
  }
  EXPECT_GT(apart, wanted / 8);
  EXPECT_GT(together, wanted / 8);
}

// Upright triangles of which the part between the heights has two corners above each other: the same point of the
// plane. If rounding separates them, they form a side without a direction, which would let bodies pass.
TEST(Surfaces, UprightTrianglesAreMetAlongAllOfThem) {
  struct Case {
    std::array<SpaceVector, 3> corners;
    Pose at;
    double length_m, width_m, low_m, high_m, depth_m;
  };
  const std::array<Case, 2> cases = {Case{{{{0.21188949925928569, 0.73215982556032855, 1.0913090541590307},
                                            {-0.53682357622416776, -0.21024680130548157, 1.301258167742247},
                                            {-0.53682357622416776, -0.21024680130548157, 0.63515656223069272}}},
                                          {-0.37173751622415718, -0.38950173867692994, 0},
                                          0.26804871697497501,
                                          0.7966338196573961,
                                          1.1566128360466146,
                                          1.7387014708554647,
                                          0.0796},
                                     Case{{{{-1.159322230026117, -0.086448046969417325, 0.83488532164663609},
                                            {-2.5545408538710639, 1.1300096407376314, 0.8030086636877467},
                                            {-2.5545408538710639, 1.1300096407376314, 0.41671700060668759}}},
                                          {-2.2338550232279082, 0.84067466908505972, 0},
                                          0.051934784297637218,
                                          0.30137047578205384,
                                          0.39755343481904354,
                                          0.85459129405345591,
                                          0.025}};
  for (const Case& c : cases) {
    TriangleMesh one;
    add_triangle(one, c.corners[0], c.corners[1], c.corners[2]);
    const MeshObstacle mesh = mesh_obstacle("one", one);
    Shape box;
    box.pose = c.at;
    box.length_m = c.length_m;
    box.width_m = c.width_m;
    box.z_low_m = c.low_m;
    box.z_high_m = c.high_m;
    EXPECT_TRUE(MeshTree({&mesh, 1}).collides(box));
    EXPECT_LT(Surfaces({&mesh, 1}).separation(outline_of(box), c.low_m, c.high_m, 0).distance_m, -0.9 * c.depth_m);
  }
}

TEST(Surfaces, NearAreAllThatBoundsTouch) {
  Draws draw(2);
  const MeshObstacle mesh = mesh_obstacle("mesh", random_triangles(draw, 500, 20, 2, 2));
  const Surfaces surfaces({&mesh, 1});
  std::vector<std::uint32_t> found;
  for (int k = 0; k < 1000; ++k) {
    const Point low = {draw(-20, 18), draw(-20, 18)};
    const Bounds bounds = {low, {low.x + draw(0, 4), low.y + draw(0, 4)}};
    const double z_low_m = draw(0, 2), z_high_m = z_low_m + draw(0, 0.5);
    surfaces.near(bounds, z_low_m, z_high_m, found);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
      const Triangle& triangle = surfaces.triangle(i);
      if (triangle.low_m() < z_high_m && z_low_m < triangle.high_m() && bounds.overlaps(bounds_of(surfaces.outline(i))))
        expected.push_back(i);
    }
    ASSERT_EQ(found, expected);
  }
}

TEST(MeshTree, RaysAreThoseOfAskingEveryTriangleToTheLastBit) {
  Draws draw(3);
  for (int scene = 0; scene < 10; ++scene) {
    const MeshObstacle mesh = mesh_obstacle("mesh", random_triangles(draw, 400, 15, 1.5, 2));
    const Surfaces surfaces({&mesh, 1});
    const MeshTree tree({&mesh, 1});
    for (int k = 0; k < 40; ++k) {
      const double height_m = draw(0, 2);
      const Point origin = {draw(-15, 15), draw(-15, 15)};
      std::vector<Point> directions;
      for (int i = 0; i < 200; ++i) {
        const auto [s, c] = exact::sincos(2 * exact::pi * i / 200);
        directions.push_back({c, s});
      }
      std::vector<double> ranges(directions.size(), k % 2 == 0 ? 10 : HUGE_VAL);
      const double limit_m = ranges[0];
      tree.cast(origin, directions, height_m, ranges);
      const Surfaces::Cut all = surfaces.cut(height_m);
      for (std::size_t i = 0; i < directions.size(); ++i) {
        double range_m = limit_m;
        for (const Outline& segment : all.segments)
          range_m = std::min(range_m, hit_distance(segment, {origin, directions[i]}));
        ASSERT_EQ(ranges[i], range_m) << scene << " " << k << " " << i;
      }
    }
  }
}

// The distance to the ray's intersection with the triangle, in extended precision; negative without one, NaN if
// rounding may decide.
long double meets_at(const Triangle& triangle, Point origin, Point direction, double height_m) {
  using Real = long double;
  const auto& [a, b, c] = triangle.corners;
  const Real ab[3] = {Real(b.x) - a.x, Real(b.y) - a.y, Real(b.z) - a.z};
  const Real ac[3] = {Real(c.x) - a.x, Real(c.y) - a.y, Real(c.z) - a.z};
  const Real from[3] = {Real(origin.x) - a.x, Real(origin.y) - a.y, Real(height_m) - a.z};
  const Real d[3] = {direction.x, direction.y, 0};
  const auto cross_of = [](const Real* p, const Real* q, Real* out) {
    out[0] = p[1] * q[2] - p[2] * q[1];
    out[1] = p[2] * q[0] - p[0] * q[2];
    out[2] = p[0] * q[1] - p[1] * q[0];
  };
  const auto dot_of = [](const Real* p, const Real* q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; };
  Real across[3], turned[3];
  cross_of(d, ac, across);
  const Real determinant = dot_of(ab, across);
  if (std::fabs(determinant) < 1e-6L) return NAN;
  const Real u = dot_of(from, across) / determinant;
  cross_of(from, ab, turned);
  const Real v = dot_of(d, turned) / determinant, t = dot_of(ac, turned) / determinant;
  const Real inside = std::min({u, v, 1 - u - v});
  if (std::fabs(inside) < 1e-6L) return NAN;
  return inside > 0 && t > 0 ? t : -1;
}

TEST(MeshTree, RaysMeetTrianglesWhereExtendedPrecisionSays) {
  Draws draw(4);
  const MeshObstacle mesh = mesh_obstacle("mesh", random_triangles(draw, 60, 6, 1.5, 2));
  const MeshTree tree({&mesh, 1});
  long hits = 0;
  for (int k = 0; k < 45'000; ++k) {
    const Point origin = {draw(-6, 6), draw(-6, 6)};
    const auto [s, c] = exact::sincos(draw(-3.2, 3.2));
    const Point direction = {c, s};
    const double height_m = draw(0, 2);
    double range_m = 20;
    tree.cast(origin, {&direction, 1}, height_m, {&range_m, 1});
    long double expected_m = 20;
    bool grazes = false;
    for (std::size_t i = 0; i < mesh.mesh->triangles.size(); ++i) {
      if (mesh.mesh->triangle(i).low_m() == mesh.mesh->triangle(i).high_m()) continue;  // level, at another height
      const long double at_m = meets_at(mesh.mesh->triangle(i), origin, direction, height_m);
      grazes = grazes || std::isnan(at_m);
      if (at_m > 0) expected_m = std::min(expected_m, at_m);
    }
    if (grazes) continue;
    ASSERT_NEAR(range_m, static_cast<double>(expected_m), 1e-9) << k;
    hits += range_m < 20 ? 1 : 0;
  }
  EXPECT_GT(hits, 10'000);
}

TEST(MeshWorld, BothEnginesAreOneToTheLastBit) {
  Draws draw(5);
  WorldDescription description;
  for (int i = 0; i < 3; ++i)
    description.meshes.push_back(mesh_obstacle(numbered("mesh ", i), random_triangles(draw, 60, 10, 0.8, 2)));
  for (int i = 0; i < 6; ++i) {
    BodyDescription body = nimble_body(numbered("r", i), i % 2 == 0 ? cylinder({0, 0}, 0.2) : box({}, 0.5, 0.3),
                                       {draw(-9, 9), draw(-9, 9), 0});
    body.sensors<Lasers>() = {perfect_laser(0.4), perfect_laser(0.9)};
    body.sensors<Sonars>().emplace_back();
    body.sensors<Bumpers>().emplace();
    description.bodies.push_back(body);
    while (!start_overlaps(description).empty()) description.bodies.back().start = {draw(-9, 9), draw(-9, 9), 0};
  }
  const auto fcl = make_kinematic_world(description, 1);
  description.engine = Engine::slice;
  const auto slice = make_kinematic_world(description, 1);
  std::uint64_t collisions = 0;
  LaserScan a, b;
  std::vector<double> sonar_a, sonar_b;
  for (int step = 0; step < 1500; ++step) {
    for (std::uint32_t i = 0; i < description.bodies.size(); ++i) {
      const BodyId id{i};
      if (step % 40 == 0) {
        const Velocity velocity = {draw(-1, 2), draw(-1, 1)};
        fcl->command(id, velocity);
        slice->command(id, velocity);
      }
      ASSERT_EQ(fcl->body(id).pose, slice->body(id).pose) << step;
      ASSERT_EQ(reading<Bumpers>(*fcl, id).pressed, reading<Bumpers>(*slice, id).pressed);
      if (step % 10 != 0) continue;
      for (std::size_t laser = 0; laser < 2; ++laser) {
        fcl->scan(id, laser, 1, a);
        slice->scan(id, laser, 1, b);
        ASSERT_EQ(a.range_m, b.range_m) << step;
      }
      fire(*fcl, id, 0, 1, sonar_a);
      fire(*slice, id, 0, 1, sonar_b);
      ASSERT_EQ(sonar_a, sonar_b);
    }
    fcl->step();
    slice->step();
  }
  for (std::uint32_t i = 0; i < description.bodies.size(); ++i) collisions += fcl->body(BodyId{i}).collisions;
  EXPECT_GT(collisions, 20u);
}

}  // namespace
}  // namespace waitpoint::world
