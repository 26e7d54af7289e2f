// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "modules/executive/tracking_law.hpp"

namespace waitpoint::executive {
namespace {

Duration seconds(double value) { return Duration::from_seconds(value); }

std::string refusal(const std::string& text) {
  try {
    const Trajectory trajectory(text, "t.tum");
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

// Half a metre per second along y, from a stamp of the year 2001.
const char* const straight =
    "# stamp x y z qx qy qz qw\n"
    "976052857.5 1 2 0 0 0 0.70710678 0.70710678\n"
    "976052859.5 1 3 0 0 0 0.70710678 0.70710678\n"
    "976052859.5 9 9 0 0 0 0 1\n"
    "976052861.5 1 4 0 0 0 0.70710678 0.70710678 # the end\n";

TEST(Trajectory, ItsPosesAndSpeedsAreThoseBetweenItsStamps) {
  const Trajectory trajectory(straight, "t.tum");
  EXPECT_NEAR(trajectory.duration().seconds(), 4, 1e-6);
  const TrajectoryPoint at = trajectory.at(seconds(1));
  EXPECT_NEAR(at.pose.y, 2.5, 1e-6);
  EXPECT_NEAR(at.pose.heading, exact::pi / 2, 1e-6);
  EXPECT_NEAR(at.v_m_s, 0.5, 1e-6);
  EXPECT_NEAR(at.w_rad_s, 0, 1e-6);
  EXPECT_NEAR(trajectory.at(seconds(9)).pose.y, 4, 1e-6);
  EXPECT_EQ(trajectory.at(seconds(9)).v_m_s, 0);
}

TEST(Trajectory, BadLinesAreToldWithTheirPlace) {
  EXPECT_EQ(refusal("1 0 0 0 0 0 0 1\n"), "t.tum: expected a trajectory of two poses or more");
  EXPECT_EQ(refusal("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 7\n").substr(0, 17), "t.tum:2: expected");
  EXPECT_EQ(refusal("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0\n").substr(0, 17), "t.tum:2: expected");
  EXPECT_EQ(refusal("9 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n"), "t.tum:2: expected a stamp after the one before");
  EXPECT_EQ(refusal("1 0 0 0 0 0 0 1\n1e9 0 0 0 0 0 0 1\n"), "t.tum:2: expected a stamp within a day of the first");
}

// A robot that begins beside a drive around a circle, by exact motion of its speeds.
TEST(TrackingLaw, ARobotBesideItsTrajectoryComesToItAndStays) {
  Pose robot{0.1, -0.15, 0.3};
  constexpr double step_s = 0.05, v = 0.4, w = 0.2;
  Pose wanted;
  for (int i = 0; i < 400; ++i) {
    const posters::SpeedInput speeds = tracking_speeds({wanted, v, w}, robot);
    robot = compose(robot, {speeds.v_m_s * step_s, 0, speeds.w_rad_s * step_s});
    wanted = compose(wanted, {v * step_s, 0, w * step_s});
  }
  EXPECT_LT(length(robot.position() - wanted.position()), 0.01);
  EXPECT_LT(std::fabs(exact::wrap_angle(robot.heading - wanted.heading)), 0.01);
}

TEST(TrackingLaw, BackwardsItComesToItToo) {
  Pose robot{0, 0.1, 0};
  Pose wanted;
  for (int i = 0; i < 400; ++i) {
    const posters::SpeedInput speeds = tracking_speeds({wanted, -0.4, 0}, robot);
    robot = compose(robot, {speeds.v_m_s * 0.05, 0, speeds.w_rad_s * 0.05});
    wanted = compose(wanted, {-0.02, 0, 0});
  }
  EXPECT_LT(length(robot.position() - wanted.position()), 0.01);
}

}  // namespace
}  // namespace waitpoint::executive
