// SPDX-License-Identifier: BSD-3-Clause
// The diagram, its gaps and regions, and the choice among them.
#include "modules/ndd/diagram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "modules/ndd/region_choice.hpp"
#include "tests/modules/ndd/points.hpp"

namespace waitpoint::ndd {
namespace {

constexpr double robot_width = 0.52;

// Points at one distance over an arc, a degree apart.
void add_arc(std::vector<Point>& points, double distance, double from_degrees, double to_degrees) {
  for (double a = from_degrees; a <= to_degrees; a += 1) points.push_back(polar(distance, a));
}

TEST(Diagram, SectorsAreTwoDegreesAndWrap) {
  EXPECT_EQ(Diagram::sector_at(0), 90);
  EXPECT_EQ(Diagram::sector_at(90 * degree), 135);
  EXPECT_EQ(Diagram::sector_at(-90 * degree), 45);
  EXPECT_EQ(Diagram::sector_at(180 * degree), 0);
  EXPECT_EQ(Diagram::sector_at(-180 * degree), 0);
  EXPECT_EQ(Diagram::sector_at(0.9 * degree), 90);
  EXPECT_EQ(Diagram::sector_at(1.1 * degree), 91);
  for (int i = 0; i < sector_count; ++i) EXPECT_EQ(Diagram::sector_at(Diagram::bisector_rad(i)), i);
  const Diagram diagram = diagram_of({polar(1, 180)});
  EXPECT_TRUE(diagram[0].occupied());
  EXPECT_TRUE(diagram[sector_count].occupied());
  EXPECT_TRUE(diagram[-sector_count].occupied());
}

TEST(Diagram, KeepsTheNearestPointOfASectorWithinRange) {
  const Diagram diagram = diagram_of({polar(2, 0), polar(1.5, 0.5), polar(3, -0.5), polar(9, 40)});
  EXPECT_NEAR(diagram[90].distance_m, 1.5, 1e-12);
  EXPECT_NEAR(diagram[90].angle_rad, 0.5 * degree, 1e-12);
  EXPECT_FALSE(diagram[110].occupied());
}

TEST(Regions, EmptyDiagramIsOneRegionAndAClosedRoomNone) {
  Regions regions;
  find_regions(diagram_of({}), robot_width, regions);
  ASSERT_EQ(regions.size(), 1u);
  EXPECT_EQ(regions[0].sectors, sector_count);
  std::vector<Point> room;
  add_arc(room, 2, -180, 179);
  find_regions(diagram_of(room), robot_width, regions);
  EXPECT_TRUE(regions.empty());
}

TEST(Regions, LieBetweenGapsThatAscend) {
  std::vector<Point> points;
  add_arc(points, 2, -180, 179);
  add_arc(points, 1, 30, 60);  // an obstacle in front of the wall: no way between it and the wall's nearer side
  Regions regions;
  find_regions(diagram_of(points), robot_width, regions);
  ASSERT_EQ(regions.size(), 1u);
  EXPECT_TRUE(regions[0].opens_at_left && regions[0].opens_at_right);
  EXPECT_TRUE(regions[0].holds(90));
  EXPECT_FALSE(regions[0].holds(Diagram::sector_at(45 * degree)));
  EXPECT_EQ(regions[0].sectors, sector_count - 16);
}

TEST(Regions, WrapAroundBehindTheRobot) {
  std::vector<Point> points;
  add_arc(points, 2, -150, 150);
  Regions regions;
  find_regions(diagram_of(points), robot_width, regions);
  ASSERT_EQ(regions.size(), 1u);
  EXPECT_NEAR(std::fabs(regions[0].middle_rad()), exact::pi, 1e-9);
  EXPECT_NEAR(regions[0].width_rad(), 58 * degree, 2.1 * degree);
}

TEST(Reachable, PassageMustBeWiderThanTheRobot) {
  for (const double width : {0.45, 0.60}) {
    std::vector<Point> jambs;
    for (double y = width / 2; y < 3; y += 0.05) jambs.push_back({1, y}), jambs.push_back({1, -y});
    EXPECT_EQ(reachable(diagram_of(jambs), {2, 0}, robot_width), width > robot_width) << width;
  }
}

TEST(Reachable, TargetMustHaveRoomForTheRobot) {
  EXPECT_FALSE(reachable(diagram_of({{2, 0.2}}), {2, 0}, robot_width));
  EXPECT_TRUE(reachable(diagram_of({{2, 0.3}}), {2, 0}, robot_width));
}

TEST(RegionChoice, GoalInSightIsTheTarget) {
  const Diagram diagram = diagram_of({});
  Regions regions;
  find_regions(diagram, robot_width, regions);
  const Choice choice = choose_region(diagram, regions, {3, 1}, std::nullopt, robot_width);
  EXPECT_TRUE(choice.found && choice.goal_reachable);
  EXPECT_EQ(choice.target, (Point{3, 1}));
}

Choice choice_past_a_disc(double aside, std::optional<Point> previous) {
  std::vector<Point> points;
  for (double a = 0; a < 360; a += 3) {
    const Point p = polar(0.26, a);
    points.push_back({2 + p.x, aside + p.y});
  }
  const Diagram diagram = diagram_of(points);
  Regions regions;
  find_regions(diagram, robot_width, regions);
  return choose_region(diagram, regions, {5, 0}, previous, robot_width);
}

TEST(RegionChoice, PassesOnTheNearerSideAndOnTheRightIfBothAreAlike) {
  EXPECT_LT(choice_past_a_disc(0, std::nullopt).target.y, 0);
  EXPECT_LT(choice_past_a_disc(0.05, std::nullopt).target.y, 0);
  EXPECT_LT(choice_past_a_disc(-0.05, std::nullopt).target.y, 0);
  EXPECT_GT(choice_past_a_disc(-0.2, std::nullopt).target.y, 0);
}

TEST(RegionChoice, KeepsTheSideChosenBefore) {
  const Point left = choice_past_a_disc(-0.2, std::nullopt).target;
  ASSERT_GT(left.y, 0);
  EXPECT_GT(choice_past_a_disc(0.05, left).target.y, 0);
}

TEST(RegionChoice, ClosedInIsNoChoice) {
  std::vector<Point> points;
  add_arc(points, 0.6, -180, 179);
  const Diagram diagram = diagram_of(points);
  Regions regions;
  find_regions(diagram, robot_width, regions);
  EXPECT_FALSE(choose_region(diagram, regions, {3, 0}, std::nullopt, robot_width).found);
}

}  // namespace
}  // namespace waitpoint::ndd
