// SPDX-License-Identifier: BSD-3-Clause
// The laser against brute force: through the whole world, with neighbours at their poses of one step ago; and tree
// traversal against testing every shape, where rounding decides between hit and miss.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/brute_force.hpp"
#include "tests/world/scenes.hpp"
#include "world/fcl/scene.hpp"
#include "world/kinematic/start_check.hpp"

namespace waitpoint::world {
namespace {

constexpr double arena_m = 12;

std::vector<Shape> random_scene(std::uint64_t seed, int count) { return random_shapes(seed, count, arena_m); }

WorldDescription scanning_robots() {
  WorldDescription description;
  for (const Shape& shape : random_scene(1, 50)) {
    description.obstacles.push_back({numbered("o", description.obstacles.size()), shape, true});
  }
  Draws draw(2);
  while (description.bodies.size() < 5) {
    const std::size_t n = description.bodies.size();
    const Pose start = {draw(-arena_m, arena_m), draw(-arena_m, arena_m), draw(-3, 3)};
    const Shape shape = n % 2 == 0 ? cylinder({0, 0}, 0.3) : box({0.1, 0, 0}, 0.8, 0.5);
    description.bodies.push_back(nimble_body(numbered("r", n), shape, start));
    LaserDescription laser = perfect_laser(n < 3 ? 0.4 : 0.6);
    laser.mount = {0.15, 0.05, 0.2};
    description.bodies.back().sensors<Lasers>().push_back(laser);
    if (!start_overlaps(description).empty()) description.bodies.pop_back();
  }
  return description;
}

// Obstacles, and all bodies except `own` as published one step before the last.
std::vector<Shape> seen_by(const World& world, std::size_t own) {
  std::vector<Shape> shapes;
  for (const Obstacle& obstacle : world.description().obstacles) shapes.push_back(obstacle.shape);
  for (std::size_t i = 0; i < world.description().bodies.size(); ++i) {
    if (i == own) continue;
    Shape shape = world.description().bodies[i].shape;
    shape.pose = compose(world.body(BodyId(i)).arc.start, shape.pose);
    shapes.push_back(shape);
  }
  return shapes;
}

TEST(LaserScan, AgreesWithBruteForceOnAMillionBeams) {
  const WorldDescription description = scanning_robots();
  const auto world = make_kinematic_world(description, 1);
  Draws draw(3);
  LaserScan scan;
  long beams = 0, grazing = 0, hits = 0;
  for (std::uint64_t number = 1; beams < 1'000'000; ++number) {
    for (std::size_t i = 0; i < 5; ++i) world->command(BodyId(i), {draw(-40, 40), draw(-60, 60)});
    world->step();
    for (std::size_t i = 0; i < 5; ++i) {
      const LaserDescription& laser = description.bodies[i].sensors<Lasers>()[0];
      world->scan(BodyId(i), 0, number, scan);
      const Pose device = compose(world->body(BodyId(i)).pose, laser.mount);
      const brute_force::Shapes shapes(seen_by(*world, i));
      for (std::size_t k = 0; k < scan.range_m.size(); ++k, ++beams) {
        const long double angle = device.heading + scan.first_angle_rad + static_cast<double>(k) * scan.angle_step_rad;
        const brute_force::Line line = {device.x, device.y, cosl(angle), sinl(angle)};
        const long double truth = shapes.range(line, laser.height_m, laser.range_max_m);
        if (truth < laser.range_max_m) ++hits;
        if (fabsl(truth - scan.range_m[k]) <= 1e-9L) continue;
        ++grazing;
        ASSERT_TRUE(shapes.grazes(line, laser.height_m, laser.range_max_m, 1e-7, 1e-6))
            << "beam " << k << " of robot " << i << ": " << scan.range_m[k] << " instead of "
            << static_cast<double>(truth);
      }
    }
  }
  EXPECT_LT(grazing, beams / 10000);
  EXPECT_GT(hits, beams / 2);
}

double asking_all(const Scene& scene, const Ray& ray, double height_m, double limit_m) {
  double best = limit_m;
  for (std::uint32_t i = 0; i < scene.size(); ++i) {
    if (scene.reaches(i, height_m)) best = std::min(best, hit_distance(scene.outline(i), ray));
  }
  return best;
}

TEST(LaserScan, GrazingBeamsAreThoseOfAskingEveryShapeToTheLastBit) {
  const Scene scene(random_scene(4, 60));
  Draws draw(5);
  const double height_m = 0.4, limit_m = 30;
  std::vector<Point> fan;
  std::vector<double> ranges;
  long flips = 0;
  for (long beams = 0; beams < 1'000'000; beams += static_cast<long>(fan.size())) {
    const Point origin = {draw(-arena_m, arena_m), draw(-arena_m, arena_m)};
    const auto target = static_cast<std::uint32_t>(draw.below(scene.size()));
    const Point towards = grazing_direction(scene.outline(target), origin, draw);
    // The grazing ray, and its neighbours by single roundings, as a fan.
    fan.clear();
    for (int k = -2; k <= 2; ++k) {
      const double turn = k * 1e-16;
      fan.push_back({towards.x - turn * towards.y, towards.y + turn * towards.x});
    }
    ranges.assign(fan.size(), limit_m);
    scene.cast(origin, fan, height_m, Scene::none, ranges);
    for (std::size_t k = 0; k < fan.size(); ++k) {
      ASSERT_EQ(ranges[k], asking_all(scene, {origin, fan[k]}, height_m, limit_m));
    }
    if (std::fabs(ranges.front() - ranges.back()) > 1e-3) ++flips;
  }
  EXPECT_GT(flips, 1000) << "the beams are meant to graze";
}

TEST(LaserScan, AFanIsEachOfItsRaysAlone) {
  const Scene scene(random_scene(8, 60));
  Draws draw(9);
  for (int k = 0; k < 400; ++k) {
    const Point origin = {draw(-arena_m, arena_m), draw(-arena_m, arena_m)};
    const double from = draw(-3, 3), field_of_view = draw(0, 6.28);
    const std::uint64_t rays = 1 + draw.below(k % 4 == 0 ? 8 : 361);
    std::vector<Point> fan;
    for (std::uint64_t i = 0; i < rays; ++i) {
      const auto [s, c] = exact::sincos(from + field_of_view * static_cast<double>(i) / static_cast<double>(rays));
      fan.push_back({c, s});
    }
    std::vector<double> ranges(fan.size(), 30);
    scene.cast(origin, fan, 0.4, Scene::none, ranges);
    for (std::size_t i = 0; i < fan.size(); ++i) {
      ASSERT_EQ(ranges[i], asking_all(scene, {origin, fan[i]}, 0.4, 30));
    }
  }
}

TEST(LaserScan, NoBeamSlipsBetweenShapesThatShareAnEdge) {
  // A wall of cells of 5 cm whose edges are not representable, seen exactly along their common edges.
  std::vector<Shape> cells;
  cells.reserve(200);
  for (int i = 0; i < 200; ++i) cells.push_back(box({5, 0.05 * i + 0.025, 0}, 0.05, 0.05));
  const Scene scene(cells);
  for (int i = 1; i < 200; ++i) {
    for (const double heading : {0.0, 0.1, -0.3}) {
      const auto [s, c] = exact::sincos(heading);
      const Point direction = {c, s}, edge = {4.975, 0.05 * i};
      double range = 30;
      scene.cast(edge - 2 * direction, {&direction, 1}, 0.5, Scene::none, {&range, 1});
      EXPECT_NEAR(range, 2, 1e-9) << i;
    }
  }
}

TEST(LaserScan, MovedSolidsAreFoundWhereTheyAre) {
  std::vector<Shape> shapes = random_scene(6, 40);
  Scene moved(shapes, 0.3);
  Draws draw(7);
  for (int round = 0; round < 200; ++round) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      shapes[i].pose.x += draw(-0.2, 0.2);
      shapes[i].pose.heading += draw(-0.2, 0.2);
      moved.place(static_cast<std::uint32_t>(i), outline_of(shapes[i]));
    }
    const Scene fresh(shapes);
    for (int k = 0; k < 20; ++k) {
      const auto [s, c] = exact::sincos(draw(-3, 3));
      const Point direction = {c, s}, origin = {draw(-12, 12), draw(-12, 12)};
      double range_moved = 30, range_fresh = 30;
      moved.cast(origin, {&direction, 1}, 0.3, 5, {&range_moved, 1});
      fresh.cast(origin, {&direction, 1}, 0.3, 5, {&range_fresh, 1});
      ASSERT_EQ(range_moved, range_fresh);
    }
  }
}

}  // namespace
}  // namespace waitpoint::world
