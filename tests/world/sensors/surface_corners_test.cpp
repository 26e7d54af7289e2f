// SPDX-License-Identifier: BSD-3-Clause
// Sonars in front of meshes: the same echoes as from boxes of the same form.
#include "world/sensors/surface_corners.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/world/meshes.hpp"

namespace waitpoint::world {
namespace {

TriangleMesh turned(TriangleMesh mesh, double heading) {
  const auto [s, c] = exact::sincos(heading);
  for (SpaceVector& v : mesh.corners) v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
  return mesh;
}

/// The readings of a robot's ring at that pose; with `crosstalk`.
std::vector<double> readings(WorldDescription description, const Pose& at, Engine engine, bool crosstalk = false) {
  BodyDescription body = nimble_body("robot", cylinder({0, 0}, 0.1), at);
  SonarRingDescription ring;
  ring.range_noise_relative = 0;
  ring.ring_radius_m = 0.1;
  ring.crosstalk = crosstalk;
  body.sensors<Sonars>() = {ring};
  description.engine = engine;
  description.bodies = {body};
  std::vector<double> ranges;
  fire(*make_kinematic_world(description, 1), BodyId(0), 0, 1, ranges);
  return ranges;
}

int heard(const std::vector<double>& ranges) {
  return static_cast<int>(std::count_if(ranges.begin(), ranges.end(), [](double r) { return r < 3; }));
}

void expect_same(const WorldDescription& mesh, const WorldDescription& boxes, const Pose& at, bool crosstalk) {
  for (const Engine engine : {Engine::fcl, Engine::slice}) {
    const std::vector<double> of_mesh = readings(mesh, at, engine, crosstalk);
    const std::vector<double> of_boxes = readings(boxes, at, engine, crosstalk);
    for (std::size_t i = 0; i < of_boxes.size(); ++i)
      ASSERT_NEAR(of_mesh[i], of_boxes[i], 1e-9) << i << " at " << at.x << ", " << at.y << ", " << at.heading;
  }
}

TEST(SurfaceCorners, ABoxsMeshIsHeardAsTheBoxFromOutside) {
  Draws draw(1);
  int echoes = 0;
  for (int k = 0; k < 300; ++k) {
    const double heading = draw(-3, 3), length_m = draw(0.1, 1.5), width_m = draw(0.1, 1.5);
    WorldDescription mesh, boxes;
    mesh.meshes = {mesh_obstacle(
        "mesh", turned(box_mesh({-0.5 * length_m, -0.5 * width_m, 0}, {0.5 * length_m, 0.5 * width_m, 1}), heading))};
    boxes.obstacles = {{"box", box({0, 0, heading}, length_m, width_m)}};
    const double distance_m = draw(1.2, 3), bearing = draw(-3, 3);
    const Pose at = {distance_m * std::cos(bearing), distance_m * std::sin(bearing), draw(-3, 3)};
    expect_same(mesh, boxes, at, k % 2 == 0);
    if (HasFatalFailure()) return;
    echoes += heard(readings(mesh, at, Engine::slice));
  }
  EXPECT_GT(echoes, 200);
}

TEST(SurfaceCorners, AHallsMeshHasTheCornersOfFourWalls) {
  Draws draw(2);
  for (int k = 0; k < 100; ++k) {
    const double length_m = draw(1, 4), width_m = draw(1, 4);
    WorldDescription mesh, walls;
    mesh.meshes = {
        mesh_obstacle("hall", box_mesh({-0.5 * length_m, -0.5 * width_m, 0}, {0.5 * length_m, 0.5 * width_m, 1}))};
    for (const double side : {-1.0, 1.0}) {
      walls.obstacles.push_back({"wall", box({side * (0.5 * length_m + 0.1), 0, 0}, 0.2, width_m + 0.4)});
      walls.obstacles.push_back({"wall", box({0, side * (0.5 * width_m + 0.1), 0}, length_m + 0.4, 0.2)});
    }
    const Pose at = {draw(-0.35, 0.35) * length_m, draw(-0.35, 0.35) * width_m, draw(-3, 3)};
    expect_same(mesh, walls, at, k % 2 == 0);
    if (HasFatalFailure()) return;
  }
}

TEST(SurfaceCorners, AWallOfManyTrianglesHasEdgesAtItsEndsOnly) {
  WorldDescription wall;
  TriangleMesh mesh;
  for (int i = 0; i < 10; ++i)
    add_quad(mesh, {0.1 * i, 1, 0}, {0.1 * (i + 1), 1, 0}, {0.1 * (i + 1), 1, 1}, {0.1 * i, 1, 1});
  wall.meshes = {mesh_obstacle("wall", mesh)};
  BodyDescription body = nimble_body("robot", cylinder({0, 0}, 0.1), {0, 0, 0});
  SonarRingDescription ring;
  ring.count = 1;
  ring.range_noise_relative = 0;
  ring.ring_radius_m = 0;
  body.sensors<Sonars>() = {ring};
  wall.bodies = {body};
  const auto world = make_kinematic_world(wall, 1);
  std::vector<double> ranges;
  const auto read = [&](double x, double heading) {
    world->move_body(BodyId(0), {x, 0, heading});
    fire(*world, BodyId(0), 0, 1, ranges);
    return ranges.at(0);
  };
  const double up = 0.5 * exact::pi;
  EXPECT_NEAR(read(0.45, up), 1, 1e-12) << "the wall";
  EXPECT_EQ(read(0.45, up - 0.35), 3) << "towards its middle: nothing faces that way, and nothing ends there";
  EXPECT_NEAR(read(0.5, up - std::atan(0.5)), std::hypot(1, 0.5), 1e-9) << "its end";
  EXPECT_NEAR(read(-0.5, up - std::atan(0.5)), std::hypot(1, 0.5), 1e-9) << "and its beginning";
  EXPECT_EQ(read(-1.5, up - std::atan(1.5)), 3) << "edges are heard up to half of the greatest range";
}

TEST(SurfaceCorners, AboutAPointEverySectorIsOneByItself) {
  // Three walls from one point: right, up, and left: two corners above, no edge below.
  const Outline right = segment_outline({0, 0}, {1, 0}), up = segment_outline({0, 1}, {0, 0}),
                left = segment_outline({0, 0}, {-1, 0}), slanted = segment_outline({0, 0}, {-1, -1});
  const auto at_origin = [](const SurfaceCorners& of) {
    return std::count_if(of.edges().begin(), of.edges().end(), [](const ConvexEdge& e) { return e.at == Point{}; });
  };
  SurfaceCorners corners;
  corners.find(std::vector{right, up, left});
  EXPECT_EQ(corners.corners().size(), 2u);
  EXPECT_EQ(at_origin(corners), 0);
  EXPECT_EQ(corners.edges().size(), 3u) << "their other ends";
  corners.find(std::vector{right, up});
  EXPECT_EQ(corners.corners().size(), 1u);
  ASSERT_EQ(at_origin(corners), 1);
  for (const ConvexEdge& edge : corners.edges()) {
    if (edge.at != Point{}) continue;
    EXPECT_FALSE(edge.is_before({1, 1}));
    for (const Point p : {Point{-1, 1}, Point{-1, -1}, Point{1, -1}, Point{0.1, -1}}) EXPECT_TRUE(edge.is_before(p));
  }
  corners.find(std::vector{right, slanted});
  EXPECT_EQ(corners.corners().size(), 0u) << "not at a right angle";
  EXPECT_EQ(at_origin(corners), 1);
}

}  // namespace
}  // namespace waitpoint::world
