// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/point_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "tests/modules/sick/synthetic_room.hpp"

namespace waitpoint::segloc {
namespace {

using synthetic::Room;

/// A robot that is moved along a way, and what its scans and its erroneous odometry make of it.
class Drive {
 public:
  explicit Drive(const Room& room, const Pose& start) : room_(room), robot_(start), map_({}, start) {
    echoes_->mount = {0.1, 0, 0};
    laser_.beams = 181;
    look({});
  }

  /// By steps of 0.2 m; the odometry's heading drifts by 0.01 rad per metre, and its distances are 2 % too long.
  void ahead(double metres) {
    for (auto steps = std::lround(metres / 0.2); steps-- > 0;) move({0.2, 0, 0}, {0.204, 0, 0.002});
  }
  void turn(double angle_rad) {
    for (int i = 0; i < 8; ++i) move({0, 0, angle_rad / 8}, {0, 0, 1.02 * angle_rad / 8});
  }
  /// Elsewhere, without a word of the odometry.
  void carry_to(const Pose& pose) {
    robot_ = pose;
    look({});
  }
  void cover_laser(bool covered) { covered_ = covered; }

  const PointMap& map() const { return map_; }
  double error_m() const { return length(map_.pose().position() - robot_.position()); }
  double greatest_error_m() const { return greatest_error_m_; }
  bool was_lost() const { return was_lost_; }
  /// Of the past as it is known at the end.
  double corrected_error_m() const {
    const auto corrected = map_.corrected();
    EXPECT_EQ(corrected.size(), truth_.size());
    double worst = 0;
    for (std::size_t i = 0; i < truth_.size(); ++i)
      worst = std::max(worst, length(corrected[i].pose.position() - truth_[i].position()));
    return worst;
  }

 private:
  void move(const Pose& step, const Pose& odometry) {
    robot_ = compose(robot_, step);
    look(odometry);
  }
  void look(const Pose& odometry) {
    room_.scan(compose(robot_, echoes_->mount), laser_, noise_, tick_++, {}, echoes_->scan);
    matching::surface_of(*echoes_, {}, points_);
    if (covered_) points_.clear();
    map_.observe(Time::from_ns(static_cast<std::int64_t>(tick_) * 200'000'000), odometry, points_);
    truth_.push_back(robot_);
    greatest_error_m_ = std::max(greatest_error_m_, error_m());
    was_lost_ = was_lost_ || map_.lost();
  }

  const Room& room_;
  synthetic::LaserModel laser_;
  RandomStream noise_{7, "r", "sick.range"};
  std::unique_ptr<posters::Echoes> echoes_ = std::make_unique<posters::Echoes>();
  std::vector<matching::SurfacePoint> points_;
  Pose robot_;
  PointMap map_;
  std::vector<Pose> truth_;
  std::uint64_t tick_ = 0;
  double greatest_error_m_ = 0;
  bool covered_ = false, was_lost_ = false;
};

// A corridor of 2.4 m around a block of 12 m x 8 m, with things along it.
Room round_corridor() {
  Room room;
  room.add_box({8.4, 6.4, 0}, 16.8, 12.8);
  room.add_box({8.4, 6.4, 0}, 12, 8);
  for (const Point p : {Point{4, 0.3},
                        {7.5, 2.1},
                        {13, 0.4},
                        {16.4, 4},
                        {14.7, 7},
                        {16.3, 10},
                        {11, 12.4},
                        {6, 10.7},
                        {3, 12.3},
                        {0.4, 8},
                        {2.1, 5},
                        {0.3, 3.1}})
    room.add_disc({p, 0.25});
  room.add_box({5.2, 12.5, 0.3}, 0.8, 0.5);
  room.add_box({16.4, 7.3, 0.1}, 0.5, 0.9);
  return room;
}

void drive_round(Drive& drive) {
  for (const double side : {14.4, 10.4, 14.4, 10.4}) {
    drive.ahead(side);
    drive.turn(exact::pi / 2);
  }
}

TEST(PointMap, ClosesALoopAndCorrectsThePast) {
  const Room room = round_corridor();
  Drive drive(room, {1.2, 1.2, 0});
  drive_round(drive);
  drive.ahead(6);
  EXPECT_GT(drive.map().closures(), 3u);
  EXPECT_LT(drive.error_m(), 0.1);
  EXPECT_LT(drive.corrected_error_m(), 0.15);
  EXPECT_FALSE(drive.was_lost());
}

TEST(PointMap, TellsThatItIsLostAndFindsARobotThatWasCarriedAway) {
  const Room room = round_corridor();
  Drive drive(room, {1.2, 1.2, 0});
  drive_round(drive);
  drive.ahead(4);
  ASSERT_FALSE(drive.map().lost());
  const std::uint32_t before = drive.map().jumps();
  drive.carry_to({15.4, 7.5, 2.4});
  drive.turn(-0.83);
  EXPECT_TRUE(drive.was_lost());
  drive.ahead(3.6);
  drive.turn(exact::pi / 2);
  drive.ahead(8);
  EXPECT_FALSE(drive.map().lost());
  EXPECT_GT(drive.map().jumps(), before);
  EXPECT_LT(drive.error_m(), 0.15);
}

// The newest sub-map from before the loss may have fewer key scans than half of it.
TEST(PointMap, LooksForALostRobotAmongAllNumbersOfKeyScans) {
  const Room room = round_corridor();
  for (double before_m = 4; before_m < 8; before_m += 0.6) {
    Drive drive(room, {1.2, 1.2, 0});
    drive.ahead(before_m);
    drive.cover_laser(true);
    drive.ahead(0.6);
    drive.carry_to({1.2, 1.2, 0});
    drive.cover_laser(false);
    drive.ahead(5);
    EXPECT_LT(drive.error_m(), before_m + 1) << before_m;
  }
}

// A corridor with the same things every two metres, out and back: what is seen on the way back fits at many places.
TEST(PointMap, KeepsItsPlaceWherePlacesLookAlike) {
  Room room;
  room.add_box({12, 1.2, 0}, 24, 2.4);
  for (double x = 1; x < 24; x += 2) {
    room.add_disc({{x, 0.1}, 0.2});
    room.add_disc({{x + 0.7, 2.3}, 0.2});
  }
  Drive drive(room, {1.5, 1.2, 0});
  drive.ahead(20);
  drive.turn(exact::pi);
  drive.ahead(20);
  EXPECT_LT(drive.greatest_error_m(), 0.5);
  EXPECT_EQ(drive.map().jumps(), 0u);
}

TEST(PointMap, GoesOnByOdometryWhileItSeesNothing) {
  const Room room = round_corridor();
  Drive drive(room, {1.2, 1.2, 0});
  drive.ahead(4);
  drive.cover_laser(true);
  drive.ahead(1);
  EXPECT_TRUE(drive.map().lost());
  EXPECT_LT(drive.error_m(), 0.1);
  EXPECT_GT(drive.map().covariance()[0], 0.001);
  drive.cover_laser(false);
  drive.ahead(1);
  EXPECT_FALSE(drive.map().lost());
  EXPECT_LT(drive.error_m(), 0.1);
}

}  // namespace
}  // namespace waitpoint::segloc
