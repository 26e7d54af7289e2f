// SPDX-License-Identifier: BSD-3-Clause
// A log of a robot that drives a curve in a rectangular room, played to modules.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "modules/genom/module.hpp"
#include "modules/playback/playback.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::playback {
namespace {

using namespace std::chrono_literals;

constexpr double room_x_m = 8, room_y_m = 5;

// The distance to the walls of a room from (0, 0) to its far corner.
float range_in_room(const Pose& from, double angle) {
  const auto [s, c] = exact::sincos(from.heading + angle);
  const double along_x = c > 0 ? (room_x_m - from.x) / c : c < 0 ? -from.x / c : 1e9;
  const double along_y = s > 0 ? (room_y_m - from.y) / s : s < 0 ? -from.y / s : 1e9;
  return static_cast<float>(std::min(along_x, along_y));
}

// On an arc of radius 1.5 m around (4, 2.5), half a metre a second.
Pose on_the_arc(double seconds) {
  const double angle = seconds / 3;
  const auto [s, c] = exact::sincos(angle);
  return {4 + 1.5 * c, 2.5 + 1.5 * s, exact::wrap_angle(angle + exact::pi / 2)};
}

/// Five scans a second for a circle, then ten at one stamp; the odometry is exact but begins elsewhere.
logs::SensorLog log_of_room() {
  logs::SensorLog log;
  log.file = "room.log";
  const auto add = [&](double stamp_s, double pose_s) {
    const Pose pose = on_the_arc(pose_s);
    logs::LoggedScan scan{.stamp = Time() + Duration::from_seconds(1000 + stamp_s),
                          .place = 1000 * log.scans.size(),
                          .first_angle_rad = -exact::pi / 2,
                          .angle_step_rad = exact::pi / 180,
                          .range_max_m = 80,
                          .odometry = compose({-20, 7, 1}, pose)};
    for (int i = 0; i < 181; ++i)
      scan.range_m.push_back(range_in_room(pose, scan.first_angle_rad + i * scan.angle_step_rad));
    log.scans.push_back(std::move(scan));
  };
  for (int i = 0; i <= 95; ++i) add(0.2 * i, 0.2 * i);
  for (int i = 0; i < 10; ++i) add(19.2, 19.2 + 0.02 * i);
  return log;
}

scenario::RobotScenario robot_with(const std::vector<std::string>& modules) {
  scenario::RobotScenario robot;
  robot.name = "robot";
  for (const std::string& name : modules)
    robot.modules.push_back({.name = name, .type = name, .settings = {}, .written = {}});
  return robot;
}

/// Sees every odometry and every scan of the modules.
class Witness : public genom::Module {
 public:
  static inline std::map<Time, Pose> odometry;
  static inline std::map<std::uint32_t, Time> scans;

  explicit Witness(genom::ModuleSetup& setup) : Module(setup, 99), task_(add_task("look", {.period_ms = 10ms})) {
    odometry.clear();
    scans.clear();
    task_.set_permanent([&of_base = read_poster<posters::Odometry>("rflex.odometry"),
                         &of_laser = read_poster<posters::Segments>("sick.segments")] {
      posters::Odometry position;
      if (of_base.read(position) == genom::PosterStatus::ok) odometry[position.position.date] = position.position.pose;
      posters::Segments segments;
      if (of_laser.read(segments) == genom::PosterStatus::ok) scans[segments.number] = segments.date;
    });
  }

 private:
  genom::ExecutionTask& task_;
};

std::vector<genom::ModuleType> types() {
  std::vector<genom::ModuleType> types = tools::shipped_modules();
  types.push_back(genom::module_type<Witness>("witness"));
  return types;
}

TEST(Playback, EveryScanComesToTheModulesAtItsDateAlsoSeveralOfOneStamp) {
  const logs::SensorLog log = log_of_room();
  const scenario::RobotScenario robot = robot_with({"rflex", "sick", "witness"});
  Playback playback(log, robot, types(), {});
  EXPECT_EQ(playback.run_before(Time::max()), RunEnd::ended);
  ASSERT_EQ(Witness::scans.size(), log.scans.size());
  for (const logs::Played& record : playback.order().records)
    EXPECT_EQ(Witness::scans.at(static_cast<std::uint32_t>(*record.scan + 1)), record.date);
  EXPECT_EQ(playback.player().scans(), log.scans.size());
  EXPECT_GT(playback.player().greatest_delay(), Duration(100ms));  // the last of the ten had to wait
}

TEST(Playback, DeadReckoningComesToTheOdometryOfTheLogAtEveryScan) {
  const logs::SensorLog log = log_of_room();
  const scenario::RobotScenario robot = robot_with({"rflex", "sick", "witness"});
  Playback playback(log, robot, types(), {});
  playback.run_before(Time::max());
  const std::vector<StampedPose> odometry = playback.trajectory(PoseSource::odometry);
  ASSERT_EQ(odometry.size(), log.scans.size());
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    const Pose& reckoned = Witness::odometry.at(playback.order().records[i].date);
    EXPECT_NEAR(reckoned.x, odometry[i].pose.x, 1e-6);
    EXPECT_NEAR(reckoned.y, odometry[i].pose.y, 1e-6);
    EXPECT_NEAR(exact::wrap_angle(reckoned.heading - odometry[i].pose.heading), 0, 1e-6);
  }
}

// Reports faster than the module's period replace one another, and dead reckoning still comes to each that it reads.
TEST(Playback, UnreadReportsDoNotBendTheOdometry) {
  logs::SensorLog log = log_of_room();
  // A hundred after each scan, as fast as they come.
  for (std::uint64_t i = 0; i < 9500; ++i) {
    const double date_s = 0.002 * static_cast<double>(i) + 0.001;
    log.odometry.push_back({Time() + Duration::from_seconds(1000 + date_s), 1000 * (i / 100) + 1 + i % 100,
                            compose({-20, 7, 1}, on_the_arc(date_s))});
  }
  const scenario::RobotScenario robot = robot_with({"rflex", "sick", "witness"});
  Playback playback(log, robot, types(), {});
  playback.run_before(Time::max());
  const Pose last = playback.trajectory(PoseSource::odometry).back().pose;
  EXPECT_NEAR(Witness::odometry.rbegin()->second.x, last.x, 1e-6);
  EXPECT_NEAR(Witness::odometry.rbegin()->second.y, last.y, 1e-6);
}

TEST(Playback, LocalisationHasAPoseForEveryScanNearThatOfTheRoom) {
  const logs::SensorLog log = log_of_room();
  const scenario::RobotScenario robot = robot_with({"rflex", "sick", "segloc", "pom"});
  Playback playback(log, robot, types(), {});
  playback.run_before(Time::max());
  const std::vector<StampedPose> localised = playback.trajectory(PoseSource::segloc);
  ASSERT_EQ(localised.size(), log.scans.size());
  for (const StampedPose& at : localised) {
    const Pose truth = between(*log.scans.front().odometry, *log.scans[at.scan].odometry);
    EXPECT_LT(length(at.pose.position() - truth.position()), 0.05);
  }
  EXPECT_TRUE(playback.has(PoseSource::pom));
  EXPECT_GE(playback.trajectory(PoseSource::pom).size(), log.scans.size() - 2);
}

TEST(Playback, ALocalisationOfAnotherNameIsStartedAndRead) {
  const logs::SensorLog log = log_of_room();
  scenario::RobotScenario robot = robot_with({"rflex", "sick", "segloc"});
  robot.modules.back().name = "slam";
  Playback playback(log, robot, types(), {});
  playback.run_before(Time::max());
  EXPECT_TRUE(playback.has(PoseSource::segloc));
  EXPECT_EQ(playback.trajectory(PoseSource::segloc).size(), log.scans.size());
}

TEST(Playback, ALaserModuleThatIsSlowGetsItsScansAllTheSame) {
  logs::SensorLog log = log_of_room();
  log.scans.resize(3);
  scenario::RobotScenario robot = robot_with({"rflex", "sick"});
  robot.modules.back().settings = {{"tasks.scanning.period_ms", "15000", "", 0}};
  Playback playback(log, robot, types(), {});
  EXPECT_EQ(playback.run_before(Time::max()), RunEnd::ended);
  EXPECT_EQ(playback.player().scans(), 3u);
}

TEST(Playback, WithSegmentsTheMapHasTheWallsOfTheRoom) {
  const logs::SensorLog log = log_of_room();
  scenario::RobotScenario robot = robot_with({"rflex", "sick", "segloc"});
  robot.modules.back().settings = {{"points.from_start", "false", "", 0}};
  Playback playback(log, robot, types(), {});
  playback.run_before(Time::max());
  EXPECT_GE(playback.segments().size(), 4u);
}

TEST(Playback, ARunInPartsIsTheSameRun) {
  const logs::SensorLog log = log_of_room();
  const scenario::RobotScenario robot = robot_with({"rflex", "sick", "segloc", "pom"});
  Playback whole(log, robot, types(), {}), parts(log, robot, types(), {});
  whole.run_before(Time::max());
  for (int i = 1; parts.run_before(Time() + Duration(37ms) * i) == RunEnd::time_reached;) ++i;
  EXPECT_EQ(to_string(whole.simulation().digest()), to_string(parts.simulation().digest()));
}

TEST(Playback, ModulesThatDoNotReadTheLogAreNamed) {
  const logs::SensorLog log = log_of_room();
  scenario::RobotScenario robot = robot_with({"rflex"});
  robot.written = {"l.yaml", 4};
  try {
    const Playback playback(log, robot, types(), {});
    FAIL() << "expected BadInput";
  } catch (const BadInput& error) {
    EXPECT_STREQ(error.what(), "l.yaml:4: expected a module that reads 'sick.reading', which the log feeds");
  }
}

}  // namespace
}  // namespace waitpoint::playback
