// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "modules/logs/log_file.hpp"

namespace waitpoint::logs {
namespace {

constexpr double degree = exact::pi / 180;

SensorLog parsed(const std::string& text, const LogChoice& choice = {}) { return parse_log("a.log", text, choice); }

std::string message(const std::string& text, const LogChoice& choice = {}) {
  try {
    parsed(text, choice);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

// n ranges of 2 m.
std::string ranges(int n) {
  std::string text = std::to_string(n);
  for (int i = 0; i < n; ++i) text += " 2";
  return text;
}

TEST(CarmenLog, AScanHasItsRangesItsOdometryAndItsStampToTheNanosecond) {
  const SensorLog log = parsed("# a comment\nFLASER 3 1.5 2.5 81.83 9 9 9 1 2 0.5 976052857.337512345 host 0.1\n");
  ASSERT_EQ(log.scans.size(), 1u);
  const LoggedScan& scan = log.scans.front();
  EXPECT_EQ(scan.range_m, (std::vector<float>{1.5f, 2.5f, 81.83f}));
  EXPECT_EQ(*scan.odometry, (Pose{1, 2, 0.5}));
  EXPECT_EQ(scan.stamp.ns(), 976052857'337512345);
  EXPECT_EQ(log.laser, "FLASER");
}

TEST(CarmenLog, ASickHasABeamADegreeFromTheRightOrTwoIfItHasMoreThan181) {
  for (const auto& [beams, step] : {std::pair{180, degree}, {181, degree}, {361, degree / 2}, {541, degree / 3}}) {
    const SensorLog log = parsed("FLASER " + ranges(beams) + " 0 0 0 0 0 0 1 h 1\n");
    EXPECT_DOUBLE_EQ(log.scans.front().first_angle_rad, -90 * degree);
    EXPECT_DOUBLE_EQ(log.scans.front().angle_step_rad, step) << beams;
    EXPECT_EQ(log.scans.front().range_max_m, 80);
  }
}

TEST(CarmenLog, ADescribedLaserHasItsOwnAnglesAndRange) {
  const SensorLog log = parsed("ROBOTLASER1 0 -1.2 2.4 0.04 30 0.01 0 2 4 5 1 77 1.5 2 0.5 1 2 0.5 0 0 0 0 0 3 h 3\n");
  const LoggedScan& scan = log.scans.front();
  EXPECT_EQ(scan.first_angle_rad, -1.2);
  EXPECT_EQ(scan.angle_step_rad, 0.04);
  EXPECT_EQ(scan.range_max_m, 30);
  EXPECT_EQ(scan.range_m, (std::vector<float>{4, 5}));
  EXPECT_EQ(*scan.odometry, (Pose{1, 2, 0.5}));
}

TEST(CarmenLog, RecordsOfGMappingHaveOnePoseAndNoHost) {
  const SensorLog log = parsed("PARAM delta 0.05\nODOM 1 2 0.25 7.5\nLASER_READING 2 1 2 1 2 0.5 8.25\nNEFF 30\n");
  EXPECT_EQ(log.laser, "LASER_READING");
  EXPECT_EQ(*log.scans.front().odometry, (Pose{1, 2, 0.5}));
  ASSERT_EQ(log.odometry.size(), 1u);
  EXPECT_EQ(log.odometry.front().stamp, Time() + Duration::from_seconds(7.5));
  EXPECT_EQ(log.left_out.at("NEFF"), 1u);
}

TEST(CarmenLog, TheLasersPoseOnTheRobotIsThatBetweenTheTwoPosesOfItsRecords) {
  const SensorLog log = parsed("FLASER 1 2 0.2 0 0 0 0 0 1 h 1\nFLASER 1 2 1 1.2 1.570796 1 1 1.570796 2 h 2\n");
  EXPECT_NEAR(log.mount.x, 0.2, 1e-5);
  EXPECT_NEAR(log.mount.y, 0, 1e-5);
}

TEST(CarmenLog, CorrectedLogsTakeTheMountFromParameters) {
  const SensorLog log =
      parsed("PARAM robot_frontlaser_offset 0.1\nFLASER 1 2 0 0 0 0 0 0 1 h 1\nFLASER 1 2 5 1 1 1 1 0 2 h 2\n");
  EXPECT_EQ(log.mount, (Pose{0.1, 0, 0}));
}

TEST(CarmenLog, AnotherLaserCanBeChosen) {
  const std::string text = "FLASER 1 2 0 0 0 0 0 0 1 h 1\nRLASER 1 3 0 0 0 0 0 0 1 h 1\n";
  EXPECT_EQ(parsed(text).scans.front().range_m.front(), 2);
  EXPECT_EQ(parsed(text).left_out.at("RLASER"), 1u);
  EXPECT_EQ(parsed(text, {.scan = "RLASER"}).scans.front().range_m.front(), 3);
  EXPECT_EQ(message(text, {.scan = "RLASSER"}),
            "--scan: expected a type of CARMEN's records with scans, found 'RLASSER', did you mean 'RLASER'?");
}

TEST(CarmenLog, LogsOfSeveralRobotsNeedARobotsName) {
  const std::string text = "FLASER 1 2 0 0 0 0 0 0 1 ada 1\nFLASER 1 3 0 0 0 0 0 0 1 bob 1\n";
  EXPECT_EQ(message(text), "--robot: expected a name, since the log has scans of several robots: 'ada', 'bob'");
  EXPECT_EQ(parsed(text, {.robot = "bob"}).scans.front().range_m.front(), 3);
}

TEST(CarmenLog, ADamagedLineIsNamed) {
  EXPECT_EQ(message("# log\nFLASER 3 1 2\n"), "a.log:2: expected a range in metres, found the end of the line");
  EXPECT_EQ(message("FLASER 1 2 0 0 x 0 0 0 1 h 1\n"), "a.log:1: expected a number of the laser's pose, found 'x'");
  EXPECT_EQ(message("FLASER 999999999 1\n"), "a.log:1: expected the number of ranges up to 100000, found '999999999'");
  EXPECT_EQ(message("FLASER 1 2 0 0 0 0 0 0 never h 1\n"), "a.log:1: expected a time in seconds, found 'never'");
  EXPECT_EQ(message("hello\n"),
            "a.log: expected a log of CARMEN with scans (FLASER, ROBOTLASER1, LASER_READING), found none");
  EXPECT_EQ(message("RAWLASER1 0 0 3 0.1 8 0 0 1 2 0 5 h 5\n"), "a.log: expected odometry (ODOM), found none");
}

TEST(CarmenLog, ANumberBeyondItsLimitIsNamed) {
  const auto described = [](const std::string& laser, const std::string& poses) {
    return message("ROBOTLASER1 0 " + laser + " 0.01 0 3 4 5 6 0 " + poses + " 0 0 0 0 0 3 h 3\n");
  };
  EXPECT_EQ(described("-1.2 2.4 0.04 30", "0 0 0 0 0 0"), "");
  EXPECT_EQ(described("1e300 2.4 0.04 30", "0 0 0 0 0 0"),
            "a.log:1: expected the start angle within +-25, found '1e300'");
  EXPECT_EQ(described("-1.2 2.4 4 30", "0 0 0 0 0 0"),
            "a.log:1: expected the beams of a scan over at most a turn, found 3 beams, one every 4 rad");
  EXPECT_EQ(described("-1.2 2.4 0.04 1e7", "0 0 0 0 0 0"),
            "a.log:1: expected the maximum range within +-1000000, found '1e7'");
  EXPECT_EQ(described("-1.2 2.4 0.04 30", "0 0 0 1e11 0 0"),
            "a.log:1: expected a number of the robot's pose within +-1000000, found '1e11'");
  EXPECT_EQ(described("-1.2 2.4 0.04 30", "0 0 0 0 0 1e300"),
            "a.log:1: expected a number of the robot's pose within +-10000, found '1e300'");
  EXPECT_EQ(message("FLASER 1 1e39 0 0 0 0 0 0 1 h 1\n"),
            "a.log:1: expected a range in metres within +-1000000, found '1e39'");
  EXPECT_EQ(message("PARAM robot_frontlaser_angular_offset 1e9\n"),
            "a.log:1: expected degrees within +-1440, found '1e9'");
}

TEST(LogFile, ACompressedLogIsToldByItsContents) {
  const std::string gzip(
      "\037\213\010\000\000\000\000\000\002\377\163\363\161\014\166\015\122\060\122\060\324\063\125\060\002\142\103\040"
      "\333"
      "\000\231\066\320\063\062\125\310\310\057\056\121\060\340\002\000\070\256\061\064\056\000\000\000",
      53);
  EXPECT_EQ(parsed(gzip).scans.front().range_m, (std::vector<float>{1.5f, 2.5f}));
  EXPECT_EQ(message(gzip.substr(0, 40)), "a.log: expected whole gzip data, found damaged or cut off data");
}

}  // namespace
}  // namespace waitpoint::logs
