// SPDX-License-Identifier: BSD-3-Clause
// Scenarios with a log in place of a world.
#include "modules/scenario/log_reader.hpp"

#include <gtest/gtest.h>

#include "modules/scenario/scenario_reader.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::scenario {
namespace {

class LogReader : public testing::Test {
 protected:
  Scenario read(const std::string& text) { return read_scenario(folder_.write("s.yaml", "format: 1\n" + text)); }
  std::string complaint(const std::string& text) {
    std::string message = message_of<BadInput>([&] { read(text); });
    const std::string folder = folder_.path().string() + "/";
    return message.starts_with(folder) ? message.substr(folder.size()) : message;
  }

  TemporaryFolder folder_;
};

TEST_F(LogReader, AFileAloneIsRelativeToTheScenarioAndHasNoLimit) {
  const Scenario scenario = read("log: logs/a.clf.gz\nrobots: [{name: r}]\n");
  ASSERT_TRUE(scenario.log.has_value());
  EXPECT_EQ(scenario.log->file, folder_.path() / "logs/a.clf.gz");
  EXPECT_FALSE(scenario.log->laser.mount.has_value());
  EXPECT_EQ(scenario.until, Time::max().since_start());
  EXPECT_EQ(read("log: a.clf\nuntil_s: 7\nrobots: [{name: r}]\n").until, Duration::from_seconds(7));
}

TEST_F(LogReader, ReadsSelectionsAndCorrections) {
  const Scenario scenario = read(
      "log: {file: a.bag, scan: /front, odometry: /odom, robot: red, field_of_view_deg: 180,\n"
      "      mount: [0.1, -0.2, 90], range_max_m: 30}\nrobots: [{name: r}]\n");
  EXPECT_EQ(scenario.log->choice.scan, "/front");
  EXPECT_EQ(scenario.log->choice.odometry, "/odom");
  EXPECT_EQ(scenario.log->choice.robot, "red");
  EXPECT_EQ(scenario.log->laser.field_of_view_rad, exact::pi);
  EXPECT_EQ(scenario.log->laser.mount->y, -0.2);
  EXPECT_EQ(scenario.log->laser.mount->heading, exact::pi / 2);
  EXPECT_EQ(scenario.log->laser.range_max_m, 30);
}

TEST_F(LogReader, TheRobotHasModulesAndProcessorsOfItsTypeAndItsOwnButNoProgramsOrGoals) {
  const Scenario scenario = read(
      "log: a.clf\nrobot_types:\n  t:\n    shape: {radius_m: 0.3, height_m: 1}\n    lasers: [{name: eye}]\n"
      "    modules: [{name: rflex}, {name: ndd}]\n    programs: [{name: p, file: p.so}]\n"
      "robots: [{name: r, type: t, processors: [cpu], modules: [{name: ndd, enabled: false}, {name: sick}]}]\n");
  ASSERT_EQ(scenario.robots.size(), 1u);
  const RobotScenario& robot = scenario.robots.front();
  EXPECT_EQ(robot.modules.size(), 3u);
  EXPECT_FALSE(robot.modules[1].enabled);
  EXPECT_EQ(robot.processors, std::vector<std::string>{"cpu"});
  EXPECT_EQ(robot.laser_names, std::vector<std::string>{"eye"});
  EXPECT_TRUE(robot.programs.empty());
}

TEST_F(LogReader, ReportsKeysThatContradictALogAtTheirLine) {
  const std::string robots = "robots:\n  - name: r\n";
  EXPECT_EQ(complaint("log: a.clf\nworld: {step_ms: 5}\n" + robots),
            "s.yaml:3: expected no 'world' beside a log, which is in place of a world");
  EXPECT_EQ(complaint("log: a.clf\n" + robots + "expect: {collisions: 0}\n"),
            "s.yaml:5: expected no 'expect' beside a log, which is in place of a world");
  EXPECT_EQ(complaint("log: a.clf\n" + robots + "    goals: [[1, 2]]\n"),
            "s.yaml:5: expected no 'goals' in a robot whose modules a log drives");
  EXPECT_EQ(complaint("log: a.clf\n" + robots + "    shape: {radius_m: 0.3, height_m: 1}\n"),
            "s.yaml:5: expected no 'shape' in a robot whose modules a log drives");
  EXPECT_EQ(complaint("log: a.clf\n" + robots + "  - name: s\n"),
            "s.yaml:5: expected one robot, whose modules the log drives, found 2");
  EXPECT_EQ(complaint("log: a.clf\n"), "s.yaml:1: expected key 'robots' in the scenario");
}

TEST_F(LogReader, BadValuesOfALogAreToldWithTheirLine) {
  EXPECT_EQ(complaint("log: {scan: /scan}\nrobots: [{name: r}]\n"), "s.yaml:2: expected key 'file' in the log");
  EXPECT_EQ(complaint("log: {file: a, fov: 1}\nrobots: [{name: r}]\n"),
            "s.yaml:2: unknown key 'fov' in the log, expected file, scan, odometry, robot, field_of_view_deg, mount or "
            "range_max_m");
  EXPECT_EQ(complaint("log: {file: a, field_of_view_deg: 400}\nrobots: [{name: r}]\n"),
            "s.yaml:2: expected field_of_view_deg to be an angle from 0.1 to 360, found '400'");
}

}  // namespace
}  // namespace waitpoint::scenario
