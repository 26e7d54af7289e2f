// SPDX-License-Identifier: BSD-3-Clause
#include "modules/locate/finder.hpp"

#include <gtest/gtest.h>

#include "tests/modules/locate/floor.hpp"

namespace waitpoint::locate {
namespace {

// Two rooms off a corridor; the one has a pillar.
const std::vector<std::string> rooms = {
    "########################",  //
    "#..........#...........#",  //
    "#..........#...........#",  //
    "#..........#....##.....#",  //
    "#..........#....##.....#",  //
    "#..........#...........#",  //
    "#..........#...........#",  //
    "#####..#########..######",  //
    "#......................#",  //
    "#......................#",  //
    "########################",
};

// Two rooms that nothing tells apart.
const std::vector<std::string> twins = {
    "##########################",  //
    "#...........##...........#",  //
    "#...........##...........#",  //
    "#...........##...........#",  //
    "#...........##...........#",  //
    "#...........##...........#",  //
    "##########################",
};

/// Turns on the spot at `pose` until the finder has a result, in steps of 0.4 rad, with an odometry of its own frame.
Finding turn(Finder& finder, const OccupancyGrid& map, Pose pose, int steps, Pose& odometry) {
  Finding finding = Finding::unchanged;
  for (int i = 0; i < steps && finding != Finding::found; ++i) {
    finding = finder.look(odometry, scan_at(map, pose));
    if (finding == Finding::found) break;
    pose.heading = exact::wrap_angle(pose.heading + 0.4);
    odometry.heading = exact::wrap_angle(odometry.heading + 0.4);
  }
  return finding;
}

TEST(Finder, FindsARobotThatTurnsOnTheSpot) {
  const OccupancyGrid map = floor_of(rooms);
  const MapSurfaces surfaces(map);
  for (const Pose start : {Pose{2, 3.5, 0.3}, Pose{9.5, 4.5, 2}, Pose{6, 1, -1.2}}) {
    Finder finder(surfaces, {});
    Pose odometry = {100, -50, 1};
    ASSERT_EQ(turn(finder, map, start, 18, odometry), Finding::found);
    const double turned = exact::wrap_angle(odometry.heading - 1);
    EXPECT_LT(length(finder.pose().position() - start.position()), 0.06);
    EXPECT_LT(std::fabs(exact::wrap_angle(finder.pose().heading - start.heading - turned)), 0.03);
  }
}

TEST(Finder, DoesNotGuessBetweenRoomsThatLookAlike) {
  const OccupancyGrid map = floor_of(twins);
  const MapSurfaces surfaces(map);
  Finder finder(surfaces, {});
  Pose odometry;
  EXPECT_EQ(turn(finder, map, {2, 1.5, 0.3}, 20, odometry), Finding::ambiguous);
}

TEST(Finder, FindsNothingOnTheWrongMap) {
  const OccupancyGrid map = floor_of(rooms);
  const MapSurfaces surfaces(floor_of({"##############", "#............#", "#............#", "##############"}));
  Finder finder(surfaces, {});
  Pose odometry;
  EXPECT_NE(turn(finder, map, {2, 3.5, 0.3}, 20, odometry), Finding::found);
}

}  // namespace
}  // namespace waitpoint::locate
