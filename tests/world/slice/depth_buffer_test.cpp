// SPDX-License-Identifier: BSD-3-Clause
// Scans by a slice against testing every shape: with the world's own shape function, to the last bit, and with
// independent intersections in extended precision. Each test runs for each available instruction set.
#include "world/slice/depth_buffer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/world/brute_force.hpp"
#include "tests/world/scenes.hpp"
#include "world/planar/ray.hpp"

namespace waitpoint::world {
namespace {

constexpr double half_square_m = 12, height_m = 0.4;

/// A fan with its directions.
struct OwnFan {
  OwnFan(Point origin, double heading, double field_of_view, std::size_t beams) {
    const auto [s, c] = exact::sincos(heading);
    fan.origin = origin;
    fan.axis = {c, s};
    fan.angle_step_rad = beams > 1 ? field_of_view / static_cast<double>(beams - 1) : 0;
    for (std::size_t i = 0; i < beams; ++i) {
      const double angle = -0.5 * field_of_view * (beams > 1) + static_cast<double>(i) * fan.angle_step_rad;
      const auto [sine, cosine] = exact::sincos(angle);
      directions.push_back({cosine, sine});
    }
    fan.directions = directions;
  }
  OwnFan(const OwnFan&) = delete;

  Point direction(std::size_t i) const {
    const Point d = directions[i];
    return {fan.axis.x * d.x - fan.axis.y * d.y, fan.axis.y * d.x + fan.axis.x * d.y};
  }

  Fan fan;
  std::vector<Point> directions;
};

struct Hit {
  double range_m;
  std::uint32_t solid;
  friend bool operator==(const Hit&, const Hit&) = default;
};

Hit asking_all(std::span<const Shape> shapes, const Ray& ray, double limit_m) {
  Hit nearest = {limit_m, no_solid};
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    if (!reaches(shapes[i], height_m)) continue;
    const double range = hit_distance(outline_of(shapes[i]), ray);
    if (range < nearest.range_m) nearest = {range, i};
  }
  return nearest;
}

// Counts the beams that hit something.
long expect_as_asking_all(std::span<const Shape> shapes, const Slice& slice, const OwnFan& fan, double limit_m) {
  std::vector<Hit> expected;
  long hits = 0;
  for (std::size_t i = 0; i < fan.directions.size(); ++i) {
    expected.push_back(asking_all(shapes, {fan.fan.origin, fan.direction(i)}, limit_m));
    hits += expected.back().solid != no_solid ? 1 : 0;
  }
  for (const Kernels* variant : all_kernels()) {
    for (const bool identify : {false, true}) {
      DepthBuffer buffer(*variant);
      buffer.begin(fan.fan, limit_m, identify);
      buffer.lower(slice);
      EXPECT_EQ(buffer.ranges_m().size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const Hit hit = {buffer.ranges_m()[i], identify ? buffer.solids()[i] : expected[i].solid};
        if (hit == expected[i]) continue;
        ADD_FAILURE() << variant->name << ", beam " << i << " of " << expected.size() << ": solid " << hit.solid
                      << " at " << hit.range_m << " instead of " << expected[i].solid << " at " << expected[i].range_m;
        return hits;
      }
    }
  }
  return hits;
}

TEST(DepthBuffer, AFanIsEachOfItsBeamsAskedOfEveryShapeToTheLastBit) {
  long beams = 0, hits = 0;
  Draws draw(1);
  for (std::uint64_t scene = 1; beams < 150'000; ++scene) {
    const std::vector<Shape> shapes = random_shapes(scene, static_cast<int>(draw.below(90)), half_square_m);
    const Slice slice(shapes, height_m);
    for (int k = 0; k < 12 && !testing::Test::HasFailure(); ++k) {
      const Point origin = {draw(-half_square_m, half_square_m), draw(-half_square_m, half_square_m)};
      const double field_of_view = k % 3 == 0 ? 2 * exact::pi : draw(0.01, 2 * exact::pi);
      const std::size_t count = 1 + draw.below(k % 4 == 0 ? 12 : 500);
      const OwnFan fan(origin, draw(-3.2, 3.2), field_of_view, count);
      hits += expect_as_asking_all(shapes, slice, fan, k % 5 == 0 ? HUGE_VAL : draw(1, 30));
      beams += static_cast<long>(count);
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(hits, beams / 2);
}

TEST(DepthBuffer, AFewBeamsFarAndNearAreEachAskedOfEveryShapeToTheLastBit) {
  // So dense that near beams end within one node, and far ones cross many nodes.
  const std::vector<Shape> shapes = random_shapes(8, 1500, half_square_m);
  const Slice slice(shapes, height_m);
  Draws draw(9);
  long hits = 0, beams = 0;
  for (int k = 0; k < 1500 && !testing::Test::HasFailure(); ++k) {
    const Point origin = {draw(-half_square_m, half_square_m), draw(-half_square_m, half_square_m)};
    const std::size_t count = 1 + draw.below(17);
    const OwnFan fan(origin, draw(-3.2, 3.2), k % 2 == 0 ? 2 * exact::pi : draw(0.01, 3), count);
    hits += expect_as_asking_all(shapes, slice, fan, k % 7 == 0 ? HUGE_VAL : k % 3 == 0 ? draw(5, 30) : draw(0.1, 2));
    beams += static_cast<long>(count);
  }
  EXPECT_GT(hits, beams / 3);
}

// If a node has fewer than eight children, the others are far away on the diagonal.
TEST(DepthBuffer, BeamsWithoutEndMeetNothingWhereThereIsNothing) {
  const std::vector<Shape> shapes = random_shapes(8, 3, half_square_m);
  const Slice slice(shapes, height_m);
  for (const double heading_rad : {0.25 * exact::pi, -0.25 * exact::pi, 0.75 * exact::pi, 0.0})
    for (const std::size_t count : {std::size_t{1}, std::size_t{3}, std::size_t{16}}) {
      const OwnFan fan({2 * half_square_m, 2 * half_square_m}, heading_rad, count == 1 ? 0 : 0.2, count);
      expect_as_asking_all(shapes, slice, fan, HUGE_VAL);
    }
}

TEST(DepthBuffer, GrazingBeamsAreThoseOfAskingEveryShapeToTheLastBit) {
  const std::vector<Shape> shapes = random_shapes(4, 60, half_square_m);
  const Slice slice(shapes, height_m);
  Draws draw(5);
  long flips = 0;
  for (int k = 0; k < 30'000; ++k) {
    const Point origin = {draw(-half_square_m, half_square_m), draw(-half_square_m, half_square_m)};
    const Outline target = outline_of(shapes[draw.below(shapes.size())]);
    OwnFan fan(origin, 0, 0, 0);
    fan.fan.axis = grazing_direction(target, origin, draw);
    // The grazing beam, and its neighbours by single roundings, as a fan.
    fan.fan.angle_step_rad = 1e-16;
    for (int i = -2; i <= 2; ++i) fan.directions.push_back({1, i * 1e-16});
    fan.fan.directions = fan.directions;
    expect_as_asking_all(shapes, slice, fan, 30);
    const double first = asking_all(shapes, {origin, fan.direction(0)}, 30).range_m;
    if (std::fabs(first - asking_all(shapes, {origin, fan.direction(4)}, 30).range_m) > 1e-3) ++flips;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(flips, 500) << "the beams are meant to graze";
}

TEST(DepthBuffer, AgreesWithBruteForceInExtendedPrecision) {
  const std::vector<Shape> shapes = random_shapes(2, 50, half_square_m);
  const Slice slice(shapes, height_m);
  const brute_force::Shapes truth_of(shapes);
  Draws draw(3);
  DepthBuffer buffer;
  long beams = 0, grazing = 0;
  while (beams < 300'000) {
    const Point origin = {draw(-half_square_m, half_square_m), draw(-half_square_m, half_square_m)};
    const double heading = draw(-3.2, 3.2), field_of_view = draw(0.5, 2 * exact::pi), limit_m = 30;
    const OwnFan fan(origin, heading, field_of_view, 361);
    buffer.begin(fan.fan, limit_m);
    buffer.lower(slice);
    for (std::size_t i = 0; i < 361; ++i, ++beams) {
      const long double angle = heading - 0.5L * field_of_view + static_cast<long double>(i) * fan.fan.angle_step_rad;
      const brute_force::Line line = {origin.x, origin.y, cosl(angle), sinl(angle)};
      const long double truth = truth_of.range(line, height_m, limit_m);
      if (fabsl(truth - buffer.ranges_m()[i]) <= 1e-9L) continue;
      ++grazing;
      ASSERT_TRUE(truth_of.grazes(line, height_m, limit_m, 1e-7, 1e-6)) << buffer.ranges_m()[i];
    }
  }
  EXPECT_LT(grazing, beams / 10000);
}

TEST(DepthBuffer, FansOfAllWidthsSeeWhatLiesBehindThem) {
  // Shapes all around; the fan is turned so that its back, where its ends may meet, runs along edges and corners.
  std::vector<Shape> shapes;
  Draws draw(6);
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * exact::pi * i / 40, distance = draw(0.5, 6);
    const auto [s, c] = exact::sincos(angle);
    shapes.push_back(i % 2 == 0 ? box({distance * c, distance * s, angle}, 0.2, draw(0.01, 1))
                                : cylinder({distance * c, distance * s}, draw(0.01, 0.3)));
  }
  const Slice slice(shapes, height_m);
  for (int k = 0; k < 600; ++k) {
    const Point corner = k % 3 == 0 ? Point{1, 0} : grazing_direction(outline_of(shapes[draw.below(40)]), {0, 0}, draw);
    const double behind = exact::atan2(-corner.y, -corner.x) + (k % 5 == 0 ? draw(-1e-4, 1e-4) : 0);
    const double turn = 2 * exact::pi;
    for (const double field_of_view : {turn, turn - 1e-9, turn - 1e-4, turn * 359 / 360, 1.5 * exact::pi, exact::pi}) {
      const OwnFan fan({0, 0}, behind, field_of_view, 1 + draw.below(720));
      expect_as_asking_all(shapes, slice, fan, 30);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(DepthBuffer, FromInsideAShapeEveryRangeIsZero) {
  std::vector<Shape> shapes = random_shapes(7, 30, half_square_m);
  shapes.push_back(box({40, 40, 0.3}, 2, 1));
  shapes.push_back(cylinder({40.2, 40.1}, 0.5));
  const Slice slice(shapes, height_m);
  for (const Point origin : {Point{40, 40}, Point{40.2, 40.1}, Point{40, 40.3}, Point{40.7, 40.1}}) {
    const OwnFan fan(origin, 1, 4, 200);
    expect_as_asking_all(shapes, slice, fan, 30);
    DepthBuffer buffer;
    buffer.begin(fan.fan, 30);
    buffer.lower(slice);
    EXPECT_EQ(*std::max_element(buffer.ranges_m().begin(), buffer.ranges_m().end()), 0);
  }
}

TEST(DepthBuffer, FromFacesCornersAndRimsItIsAskingEveryShape) {
  std::vector<Shape> shapes = {box({0, 0, 0}, 2, 1), box({2, 0, 0}, 2, 1), box({0, 3, 0.7}, 2, 1), cylinder({5, 0}, 1)};
  const Slice slice(shapes, height_m);
  for (const Shape& shape : shapes) {
    const Outline outline = outline_of(shape);
    for (const Point p : {Point{1, 0.5}, Point{1, 0}, Point{1, 0.2}, Point{-1, -0.5}, Point{0.3, 0.5}, Point{0, -1}}) {
      for (const double beside : {0.0, 1e-16, 1e-13, -1e-13, 1e-8, 1e-6, 1e-5}) {
        const Point origin = outline.centre + outline.outward((1 + beside) * p);
        for (const double heading : {0.0, 0.7, 0.5 * exact::pi, exact::pi, -1.0}) {
          expect_as_asking_all(shapes, slice, OwnFan(origin, heading, 2 * exact::pi, 361), 30);
          expect_as_asking_all(shapes, slice, OwnFan(origin, heading, exact::pi, 181), 30);
        }
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(DepthBuffer, NoBeamSlipsBetweenShapesThatTouch) {
  std::vector<Shape> cells;
  for (int i = 0; i < 200; ++i) cells.push_back(box({5, 0.05 * i + 0.025, 0}, 0.05, 0.05));
  const Slice slice(cells, height_m);
  for (int i = 1; i < 200; ++i) {
    for (const double heading : {0.0, 0.1, -0.3}) {
      const auto [s, c] = exact::sincos(heading);
      const OwnFan fan(Point{4.975, 0.05 * i} - 2 * Point{c, s}, heading, 0, 1);
      DepthBuffer buffer;
      buffer.begin(fan.fan, 30);
      buffer.lower(slice);
      EXPECT_NEAR(buffer.ranges_m()[0], 2, 1e-9) << i;
    }
  }
}

// Its edge reaches from ahead to behind, where an interval of beams wraps; the fan is narrower than the margin of
// angles.
TEST(DepthBuffer, NarrowFanAlongAWallStaysWithinItsBeams) {
  const std::vector<Shape> shapes = {box({0, 0, 0}, 10, 10)};
  const Slice slice(shapes, height_m);
  for (const double gap_m : {1e-5, 1e-4, 1e-3})
    for (const double turn_rad : {-3e-5, -1e-5, 0.0, 1e-5, 3e-5})
      expect_as_asking_all(shapes, slice, OwnFan({0, -5 - gap_m}, turn_rad - exact::pi, 1e-5, 24), 30);
}

TEST(DepthBuffer, HandlesNoShapeAndOneShape) {
  const OwnFan fan({0, 0}, 0, exact::pi, 181);
  for (const auto& shapes :
       {std::vector<Shape>{}, {cylinder({3, 0}, 1)}, {box({0, -3, 0.2}, 1, 1)}, {box({-3, 0, 0}, 1, 9)}})
    expect_as_asking_all(shapes, Slice(shapes, height_m), fan, 30);
  expect_as_asking_all({}, Slice({}, height_m), OwnFan({0, 0}, 0, 0, 0), 30);
  DepthBuffer buffer;
  buffer.begin(fan.fan, 12);
  buffer.lower(MovingSolids({}), height_m);
  EXPECT_EQ(buffer.ranges_m()[90], 12);
}

TEST(DepthBuffer, HundredThousandShapes) {
  Draws draw(8);
  std::vector<Shape> shapes;
  for (int i = 0; i < 100'000; ++i) shapes.push_back(random_shape(draw, 400, 0.8));
  const Slice slice(shapes, height_m);
  for (int k = 0; k < 3; ++k) {
    const Point origin = {draw(-300, 300), draw(-300, 300)};
    const double heading = draw(-3, 3), field_of_view = draw(1, 6);
    expect_as_asking_all(shapes, slice, OwnFan(origin, heading, field_of_view, 61), 60);
  }
}

TEST(DepthBuffer, FarFromTheOriginOfTheWorldAsNearIt) {
  // As for maps in national coordinates.
  std::vector<Shape> shapes = random_shapes(9, 60, half_square_m);
  for (Shape& shape : shapes) shape.pose.x += 4.5e5, shape.pose.y += 5.4e6;
  const Slice slice(shapes, height_m);
  Draws draw(10);
  for (int k = 0; k < 100; ++k) {
    const Point origin = {4.5e5 + draw(-half_square_m, half_square_m), 5.4e6 + draw(-half_square_m, half_square_m)};
    const double heading = draw(-3, 3), field_of_view = draw(1, 6);
    expect_as_asking_all(shapes, slice, OwnFan(origin, heading, field_of_view, 361), 30);
  }
}

TEST(DepthBuffer, AHeightOnAFaceIsWithin) {
  Shape low = cylinder({2, 0}, 0.5), high = cylinder({3, 0}, 0.5);
  low.z_high_m = height_m;
  high.z_low_m = height_m;
  for (const auto& [shape, range_m] : {std::pair(low, 1.5), std::pair(high, 2.5)}) {
    const OwnFan fan({0, 0}, 0, 0, 1);
    DepthBuffer standing, moving, below, above;
    standing.begin(fan.fan, 9);
    standing.lower(Slice({&shape, 1}, height_m));
    moving.begin(fan.fan, 9);
    moving.lower(MovingSolids({&shape, 1}), height_m);
    EXPECT_EQ(standing.ranges_m()[0], range_m);
    EXPECT_EQ(moving.ranges_m()[0], range_m);
    below.begin(fan.fan, 9);
    below.lower(Slice({&shape, 1}, std::nextafter(height_m, 0)));
    above.begin(fan.fan, 9);
    above.lower(MovingSolids({&shape, 1}), std::nextafter(height_m, 1));
    EXPECT_EQ(below.ranges_m()[0] == 9, range_m == 2.5);
    EXPECT_EQ(above.ranges_m()[0] == 9, range_m == 1.5);
  }
}

TEST(DepthBuffer, MovingSolidsAreSeenWhereTheyAreAndNotByThemselves) {
  std::vector<Shape> standing = random_shapes(11, 40, half_square_m), moving = random_shapes(12, 21, half_square_m);
  const Slice slice(standing, height_m);
  MovingSolids solids(moving, 40);
  Draws draw(13);
  DepthBuffer buffer;
  for (int round = 0; round < 150; ++round) {
    for (std::size_t i = 0; i < moving.size(); ++i) {
      moving[i].pose.x += draw(-0.4, 0.4);
      moving[i].pose.heading += draw(-0.2, 0.2);
      solids.place(i, outline_of(moving[i]));
    }
    const std::uint32_t own = 40 + static_cast<std::uint32_t>(draw.below(21));
    const Point origin = {draw(-12, 12), draw(-12, 12)};
    const double heading = draw(-3, 3), field_of_view = draw(0.1, 6);
    const OwnFan fan(origin, heading, field_of_view, 200);
    buffer.begin(fan.fan, 30, true);
    if (round % 2 == 0) buffer.lower(slice);
    buffer.lower(solids, height_m, own);
    if (round % 2 != 0) buffer.lower(slice);
    std::vector<Shape> all = standing;
    all.insert(all.end(), moving.begin(), moving.end());
    all[own].z_low_m = 100;
    all[own].z_high_m = 101;
    for (std::size_t i = 0; i < 200; ++i) {
      const Hit expected = asking_all(all, {fan.fan.origin, fan.direction(i)}, 30);
      ASSERT_EQ((Hit{buffer.ranges_m()[i], buffer.solids()[i]}), expected) << round << " " << i;
    }
  }
}

TEST(DepthBuffer, FirstOfEquallyNearSolidsIsHit) {
  const std::vector<Shape> shapes(20, box({3, 0, 0.1}, 1, 1));
  DepthBuffer buffer;
  const OwnFan fan({0, 0}, 0, 0.2, 9);
  buffer.begin(fan.fan, 30, true);
  buffer.lower(MovingSolids(shapes, 20), height_m);
  EXPECT_EQ(buffer.solids()[4], 20u);
  buffer.lower(Slice(shapes, height_m));
  EXPECT_EQ(buffer.solids()[4], 0u);
}

TEST(DepthBuffer, HitAtTheLimitIsNone) {
  const std::vector<Shape> shapes = {cylinder({3, 0}, 1)};
  DepthBuffer buffer;
  const OwnFan fan({0, 0}, 0, 0, 1);
  for (const double limit_m : {2.0, std::nextafter(2.0, 3.0)}) {
    buffer.begin(fan.fan, limit_m, true);
    buffer.lower(Slice(shapes, height_m));
    EXPECT_EQ(buffer.ranges_m()[0], 2);
    EXPECT_EQ(buffer.solids()[0] == no_solid, limit_m == 2);
  }
}

TEST(DepthBufferDeathTest, MoreThanAFullTurnIsABug) {
  const OwnFan fan({0, 0}, 0, 7, 100);
  DepthBuffer buffer;
  EXPECT_DEATH(buffer.begin(fan.fan, 30), "full turn");
}

}  // namespace
}  // namespace waitpoint::world
