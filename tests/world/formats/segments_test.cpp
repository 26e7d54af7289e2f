// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/segments.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/occupancy_grid.hpp"
#include "core/random.hpp"
#include "tests/world/formats/files.hpp"
#include "world/fcl/scene.hpp"
#include "world/formats/drawn_cells.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/world_file.hpp"
#include "world/motion/first_contact.hpp"

namespace waitpoint::world {
namespace {

std::vector<Obstacle> walls_of(const std::string& text) {
  LeftOut left_out;
  return parse_segments(text, "walls.txt", 2, left_out);
}

testing::AssertionResult rejects_walls(const std::string& text, const std::string& where, const std::string& what) {
  return complains([&] { walls_of(text); }, where, what);
}

Outline disc(Point centre, double radius_m) {
  Outline outline;
  outline.centre = centre;
  outline.radius_m = radius_m;
  return outline;
}

TEST(Segments, EachLineIsAWall) {
  const std::vector<Obstacle> walls = walls_of("# a room\n0 0 4 0\r\n\n  4,0,4,3 # the right side\n-1.5e0\t2 1 2");
  ASSERT_EQ(walls.size(), 3u);
  EXPECT_EQ(walls[0].name, "segment 0");
  EXPECT_EQ(walls[0].shape.pose, (Pose{2, 0, 0}));
  EXPECT_EQ(walls[0].shape.length_m, 4);
  EXPECT_EQ(walls[0].shape.width_m, wall_thickness_m);
  EXPECT_EQ(walls[0].shape.z_low_m, 0);
  EXPECT_EQ(walls[0].shape.z_high_m, 2);
  EXPECT_NEAR(walls[1].shape.pose.heading, exact::pi / 2, 1e-15);
  EXPECT_EQ(walls[2].shape.length_m, 2.5);
  EXPECT_TRUE(walls[2].known);
}

TEST(Segments, RangesAreThoseOfTheSegmentsToHalfTheThickness) {
  const RandomStream random(1, "", "segments");
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double heading = exact::pi * random.uniform(4 * i), along = random.uniform(4 * i + 1) - 0.5;
    const auto [s, c] = exact::sincos(heading);
    const Point centre = {100 * random.uniform(4 * i + 2), 100 * random.uniform(4 * i + 3)};
    const Shape wall = wall_between(centre - Point{3 * c, 3 * s}, centre + Point{3 * c, 3 * s}, 0, 2);
    // A ray from 5 m before the wall, at 45 degrees to it.
    const Point target = centre + Point{along * c, along * s};
    const Point direction = {std::sqrt(0.5) * (c - s), std::sqrt(0.5) * (s + c)};
    const double range = hit_distance(outline_of(wall), {target - Point{5 * direction.x, 5 * direction.y}, direction});
    EXPECT_NEAR(range, 5 - 0.5 * wall_thickness_m * std::sqrt(2.0), 1e-9);
  }
}

TEST(Segments, NoRayPassesWhereWallsShareAnEnd) {
  const RandomStream random(2, "", "corners");
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double bend = 0.05 + 3 * random.uniform(4 * i), turn = 6 * random.uniform(4 * i + 1);
    const auto [s1, c1] = exact::sincos(turn);
    const auto [s2, c2] = exact::sincos(turn + bend);
    const Point corner = {50 * random.uniform(4 * i + 2), -30};
    const Outline first = outline_of(wall_between(corner + Point{2 * c1, 2 * s1}, corner, 0, 2));
    const Outline second = outline_of(wall_between(corner, corner + Point{2 * c2, 2 * s2}, 0, 2));
    // From outside, towards the inside of the bend, through the corner to within 1e-10 m.
    const auto [s, c] = exact::sincos(turn + 0.5 * bend);
    const double offset = 2e-10 * (random.uniform(4 * i + 3) - 0.5);
    const Ray ray = {corner + Point{-3 * c - offset * s, -3 * s + offset * c}, {c, s}};
    EXPECT_LT(std::min(hit_distance(first, ray), hit_distance(second, ray)), 3.001) << i;
  }
}

TEST(Segments, ADiscAtAnySpeedStopsBeforeTheWall) {
  Shape body;
  body.kind = Shape::Kind::cylinder;
  body.radius_m = 0.25;
  const Outline wall = outline_of(wall_between({10, -3}, {10, 3}, 0, 2));
  for (const double distance_m : {10.0, 1e3, 1e4}) {
    const Mover mover(body, disc({0, 0}, 0.25), Arc{{0, 0, 0}, distance_m, 0});
    const std::optional<Contact> contact = first_contact(mover, Mover(wall), 0);
    ASSERT_TRUE(contact.has_value()) << distance_m;
    EXPECT_NEAR(contact->fraction * distance_m, 10 - 0.25 - 0.5 * wall_thickness_m - contact_gap_m, 1e-8);
  }
}

TEST(Segments, FclCollidesWithAWallAsThePlaneDoes) {
  const RandomStream random(3, "", "collisions");
  const Shape wall = wall_between({-2, -1}, {3, 1.5}, 0, 2);
  const Scene scene(std::vector<Shape>{wall});
  int met = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    Shape shape;
    shape.kind = i % 2 == 0 ? Shape::Kind::box : Shape::Kind::cylinder;
    shape.pose = {8 * random.uniform(3 * i) - 4, 6 * random.uniform(3 * i + 1) - 3, 6 * random.uniform(3 * i + 2)};
    shape.length_m = 0.6;
    shape.width_m = 0.4;
    shape.radius_m = 0.3;
    const double distance = separation(outline_of(shape), outline_of(wall)).distance_m;
    if (std::fabs(distance) < 1e-6) continue;
    EXPECT_EQ(scene.collides(shape), distance < 0) << i << ": " << distance;
    met += distance < 0 ? 1 : 0;
  }
  EXPECT_GT(met, 200);
}

TEST(Segments, AWallBetweenTwoRowsOfCellsIsDrawnIntoBoth) {
  OccupancyGrid grid(3, 4, 1, {}, Cell::free);
  draw(std::vector<Shape>{wall_between({0, 2}, {3, 2}, 0, 2)}, grid);
  for (int y = 0; y < 4; ++y) {
    const CellIndex middle = {1, y};
    EXPECT_EQ(grid[middle] == Cell::occupied, y == 1 || y == 2) << y;
  }
}

TEST(Segments, OneWithoutLengthIsLeftOutWithAWarning) {
  LeftOut left_out;
  EXPECT_EQ(parse_segments("1 1 1 1\n0 0 1 0\n2 2 2 2\n", "walls.txt", 2, left_out).size(), 1u);
  EXPECT_EQ(left_out.warnings(),
            std::vector<std::string>{"walls.txt:1: a segment without length is left out (2 times)"});
}

TEST(Segments, AWrongLineIsNamed) {
  EXPECT_TRUE(rejects_walls("0 0 1 0\n0 0 1\n",
                            "walls.txt:2: ", "'x0 y0 x1 y1' in metres within 100 km, found the line's end"));
  EXPECT_TRUE(rejects_walls("0 0 1 nan\n", "walls.txt:1: ", "found 'nan'"));
  EXPECT_TRUE(rejects_walls("0 0 1 inf\n", "walls.txt:1: ", "found 'inf'"));
  EXPECT_TRUE(rejects_walls("0 0 1 1e6\n", "walls.txt:1: ", "found '1e6'"));
  EXPECT_TRUE(rejects_walls("0 0 1 0x10\n", "walls.txt:1: ", "found '0x10'"));
  EXPECT_TRUE(rejects_walls("\n0 0 1 1 5\n", "walls.txt:2: ", "expected nothing after"));
  EXPECT_TRUE(rejects_walls("0 0 1 \x01\xff\n", "walls.txt:1: ", "found '?"));
  EXPECT_TRUE(rejects_walls("# nothing\n", "walls.txt: ", "found none"));
}

TEST(Segments, MoreThanCanBeMeantAreRefused) {
  std::string text;
  for (std::size_t i = 0; i <= obstacle_count_max; ++i) text += "0 0 1 1\n";
  EXPECT_TRUE(rejects_walls(text, "walls.txt:1048577: ", "expected at most 1048576 segments"));
}

TEST(Segments, AreReadAsAWorldOfAHeight) {
  const Folder folder;
  const WorldFile world = read_world_file(folder.write("walls", "# x0 y0 x1 y1\n-1 0 1 0\n"), 1.5);
  ASSERT_EQ(world.obstacles.size(), 1u);
  EXPECT_EQ(world.obstacles[0].shape.z_high_m, 1.5);
  EXPECT_FALSE(world.has_heights);
  EXPECT_FALSE(world.grid.has_value());
}

}  // namespace
}  // namespace waitpoint::world
