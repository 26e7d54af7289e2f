// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/seen_map.hpp"

#include <gtest/gtest.h>

#include "modules/executive/route_planner.hpp"
#include "tests/modules/executive/drawn_map.hpp"

namespace waitpoint::executive {
namespace {

// 5 m x 5 m of free cells of 5 cm; the device stands in the middle of the left side and faces right.
struct SeenMapTest : testing::Test {
  SeenMapTest() : map(test::drawn_map(std::vector<std::string>(100, std::string(100, ' ')), 0.05)), seen(map, 4) {}

  // 41 beams over 40 degrees; `range_m` gives the range by the bearing.
  template <class Range>
  void see(const Range& range_m) {
    posters::LaserReading scan;
    scan.first_angle_rad = -20 * (exact::pi / 180);
    scan.angle_step_rad = exact::pi / 180;
    scan.range_max_m = 30;
    for (int i = -20; i <= 20; ++i) scan.range_m.push_back(static_cast<float>(range_m(i * (exact::pi / 180))));
    seen.add(device, scan);
  }
  CellIndex at(Point p) const { return map.cell_at(p).value(); }

  const Pose device{0.52, 2.52, 0};
  OccupancyGrid map;
  SeenMap seen;
};

double wall_at_2_m(double bearing_rad) { return 2 / exact::sincos(bearing_rad).cos; }
double nothing(double) { return 30; }

TEST_F(SeenMapTest, CellsUpToAnEchoAreFreeItsOwnIsOccupiedAndThoseBehindAreUnseen) {
  see(wall_at_2_m);
  EXPECT_TRUE(seen.occupied(at({2.52, 2.52})));
  EXPECT_TRUE(seen.seen(at({1.5, 2.52})));
  EXPECT_FALSE(seen.occupied(at({1.5, 2.52})));
  EXPECT_FALSE(seen.seen(at({2.7, 2.52})));
  EXPECT_FALSE(seen.seen(at({1.5, 4})));
  EXPECT_GT(seen.ever_occupied().size(), 20u);
}

TEST_F(SeenMapTest, BeamsWithoutAnEchoAreFreeUpToTheRange) {
  see(nothing);
  EXPECT_TRUE(seen.seen(at({4.4, 2.52})));
  EXPECT_FALSE(seen.seen(at({4.7, 2.52})));
  EXPECT_TRUE(seen.ever_occupied().empty());
}

TEST_F(SeenMapTest, MovedObstaclesDisappearAfterSomeScans) {
  for (int i = 0; i < 20; ++i) see(wall_at_2_m);
  see(nothing);
  EXPECT_TRUE(seen.occupied(at({2.52, 2.52})));
  for (int i = 0; i < 6; ++i) see(nothing);
  EXPECT_FALSE(seen.occupied(at({2.52, 2.52})));
}

TEST_F(SeenMapTest, AThinObstacleOutlastsTheBeamsBesideIt) {
  for (int i = 0; i < 30; ++i) see([](double bearing) { return bearing == 0 ? 2.0 : 30.0; });
  EXPECT_TRUE(seen.occupied(at({2.52, 2.52})));
}

TEST_F(SeenMapTest, RoutesKeepClearOfWhatHasBeenSeenUntilItIsGone) {
  RoutePlanner planner(std::make_shared<const KnownSpace>(map, false), {});
  RoutePlan plan;
  const auto length_m = [&] {
    planner.space().see(seen);
    planner.plan({0.6, 2.5}, {4.5, 2.5}, plan);
    EXPECT_EQ(plan.outcome, PlanOutcome::found);
    return plan.length_m;
  };
  see(nothing);
  EXPECT_LT(length_m(), 3.95);
  for (int i = 0; i < 2; ++i) see(wall_at_2_m);
  EXPECT_GT(length_m(), 4.4);
  for (int i = 0; i < 6; ++i) see(nothing);
  EXPECT_LT(length_m(), 3.95);
}

TEST_F(SeenMapTest, OnAMapThatIsNotKnownSeenSpaceIsPreferred) {
  const FreeSpace known(std::make_shared<const KnownSpace>(map), {});
  FreeSpace unknown(std::make_shared<const KnownSpace>(map, false), {});
  see(nothing);
  unknown.see(seen);
  EXPECT_EQ(unknown.cell_cost(at({2, 2.52})), known.cell_cost(at({2, 2.52})));
  EXPECT_EQ(unknown.cell_cost(at({2, 4.5})), known.cell_cost(at({2, 4.5})) + FreeSpace::unseen_cell_cost);
}

}  // namespace
}  // namespace waitpoint::executive
