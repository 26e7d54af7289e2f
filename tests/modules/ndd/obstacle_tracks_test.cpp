// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/obstacle_tracks.hpp"

#include <gtest/gtest.h>

#include "tests/modules/milliseconds.hpp"
#include "tests/modules/ndd/scan_from.hpp"

namespace waitpoint::ndd {
namespace {

struct ObstacleTracksTest : testing::Test {
  // Scans every 50 ms from a robot that drives at `v`; `disc` moves at `velocity`.
  void watch(int scans, Pose robot, double v, test::Disc& disc, Point velocity) {
    for (int i = 0; i < scans; ++i) {
      now = now + Duration::from_seconds(0.05);
      robot.x += 0.05 * v;
      disc.centre = disc.centre + 0.05 * velocity;
      shapes.discs = {disc};
      const posters::Echoes echoes = scan_from(shapes, robot, now);
      tracks.see(compose(robot, echoes.mount), echoes.scan);
    }
  }

  test::Shapes shapes;
  ObstacleTracks tracks;
  Time now;
};

TEST_F(ObstacleTracksTest, TheVelocityOfADiscIsFoundFromAMovingRobot) {
  test::Disc disc = {{3, -1.5}, 0.2};
  watch(12, {}, 0.8, disc, {-0.3, 0.8});
  ASSERT_EQ(tracks.moving().size(), 1U);
  const Track& track = tracks.moving()[0];
  EXPECT_LT(length(track.velocity - Point{-0.3, 0.8}), 0.12);
  EXPECT_LT(length(track.at(now) - disc.centre), 0.05);
  EXPECT_NEAR(track.radius_m, 0.2, 0.03);
}

TEST_F(ObstacleTracksTest, StandingObstaclesHaveNoSpeedWhileTheRobotDrives) {
  test::Disc disc = {{2, 0.6}, 0.2};
  shapes.wall(-5, 2, 5, 2.2);
  watch(30, {}, 1.5, disc, {});
  EXPECT_TRUE(tracks.moving().empty());
}

TEST_F(ObstacleTracksTest, AHiddenDiscIsExpectedWhereItWouldBeForASecond) {
  test::Disc disc = {{3, -1}, 0.2};
  watch(12, {}, 0, disc, {0, 1});
  const Point last = disc.centre;
  shapes.wall(1, -2, 1.1, 2);
  test::Disc hidden = {{20, 20}, 0.2};
  watch(10, {}, 0, hidden, {});
  ASSERT_EQ(tracks.moving().size(), 1U);
  EXPECT_LT(length(tracks.moving()[0].at(now) - (last + Point{0, 0.5})), 0.1);
  watch(12, {}, 0, hidden, {});
  EXPECT_TRUE(tracks.moving().empty());
}

}  // namespace
}  // namespace waitpoint::ndd
