// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/line_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace waitpoint::segloc {
namespace {

LineObservation some_observation() {
  LineObservation o;
  o.angle_rad = 0.9;
  const Point normal{exact::cos(0.9), exact::sin(0.9)}, along{-normal.y, normal.x};
  o.start = 2.0 * normal + 0.5 * along;
  o.end = 2.0 * normal + 2.5 * along;
  o.middle = 0.5 * (o.start + o.end);
  o.length_m = 2;
  return o;
}

TEST(LineGeometry, ALineSeenComparesEqualToItself) {
  const Pose robot{3, -4, 2.2};
  const Comparison c = compare(robot, some_observation(), line_from(robot, some_observation()));
  EXPECT_NEAR(c.angle_rad, 0, 1e-12);
  EXPECT_NEAR(c.offset_m, 0, 1e-12);
}

TEST(LineGeometry, TheDerivativesAreThoseOfFiniteDifferences) {
  const Pose robot{3, -4, 2.2};
  const LineObservation o = some_observation();
  Line line = line_from({3.05, -3.98, 2.22}, o);
  line.offset_m = 0.03;
  const Comparison at = compare(robot, o, line);
  const double h = 1e-6;
  for (std::size_t k = 0; k < 3; ++k) {
    Pose p = robot, m = robot;
    (k == 0 ? p.x : k == 1 ? p.y : p.heading) += h;
    (k == 0 ? m.x : k == 1 ? m.y : m.heading) -= h;
    const Comparison a = compare(p, o, line), b = compare(m, o, line);
    // The innovation is observed minus predicted: it changes against the prediction.
    EXPECT_NEAR(at.by_pose[0][k], -(a.angle_rad - b.angle_rad) / (2 * h), 1e-7) << k;
    EXPECT_NEAR(at.by_pose[1][k], -(a.offset_m - b.offset_m) / (2 * h), 1e-7) << k;
  }
  for (std::size_t k = 0; k < 2; ++k) {
    Line p = line, m = line;
    if (k == 0) {
      p.turn_to(line.angle_rad + h);
      m.turn_to(line.angle_rad - h);
    } else {
      p.offset_m += h;
      m.offset_m -= h;
    }
    const Comparison a = compare(robot, o, p), b = compare(robot, o, m);
    EXPECT_NEAR(at.by_line[0][k], -(a.angle_rad - b.angle_rad) / (2 * h), 1e-7) << k;
    EXPECT_NEAR(at.by_line[1][k], -(a.offset_m - b.offset_m) / (2 * h), 1e-7) << k;
  }
}

TEST(LineGeometry, AnObservationsNormalPointsAwayFromTheDeviceEvenWhereTheRobotsCentreIsBehindTheLine) {
  // The device sits 0.3 m ahead of the robot's centre and sees the wall x = 0.1 from its far side, looking back at it.
  posters::Segment segment;
  segment.start = {0.1, 1};
  segment.end = {0.1, -1};  // counter-clockwise as seen from (0.3, 0)
  segment.normal_rad = 0;
  segment.distance_m = 0.1;
  segment.covariance = {1e-4, 2e-5, 1e-4};
  const LineObservation o = line_observation(segment);
  EXPECT_NEAR(std::fabs(o.angle_rad), exact::pi, 1e-12);
  EXPECT_NEAR(o.covariance[1], -2e-5, 1e-12);
}

TEST(LineGeometry, TheCovarianceMovesToTheMiddleOfTheSegment) {
  // The offset at the middle, 4 m along from the foot, is known to 1 cm, the angle to 0.01 rad, independently.
  const double lever = 4;
  posters::Segment segment;
  segment.start = {2, lever - 1};
  segment.end = {2, lever + 1};
  segment.normal_rad = 0;
  segment.distance_m = 2;
  segment.covariance = {1e-4, lever * 1e-4, 1e-4 + lever * lever * 1e-4};
  const LineObservation o = line_observation(segment);
  EXPECT_NEAR(o.covariance[0], 1e-4, 1e-15);
  EXPECT_NEAR(o.covariance[1], 0, 1e-15);
  EXPECT_NEAR(o.covariance[2], 1e-4, 1e-15);
}

}  // namespace
}  // namespace waitpoint::segloc
