// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/derived_settings.hpp"

#include <gtest/gtest.h>

#include <string>

namespace waitpoint::bridge {
namespace {

world::Shape box(double length_m, double width_m, double ahead_m = 0) {
  world::Shape shape;
  shape.length_m = length_m;
  shape.width_m = width_m;
  shape.pose.x = ahead_m;
  return shape;
}

scenario::RobotScenario robot_with_laser_at(const Pose& mount) {
  scenario::RobotScenario robot;
  robot.body.shape = box(0.42, 0.43);
  robot.body.sensors<world::Lasers>().emplace_back();
  robot.body.sensors<world::Lasers>().front().mount = mount;
  robot.laser_names = {"front"};
  robot.bridge.push_back({"sick.reading", "front.reading", {}, {}});
  return robot;
}

scenario::ModuleScenario module(const std::string& name, const std::string& type) {
  scenario::ModuleScenario module;
  module.name = name;
  module.type = type;
  return module;
}

double number(genom::Settings& settings, const std::string& key) {
  double value = -1;
  settings.read_one(key, value);
  return value;
}

std::string complaint(const scenario::RobotScenario& robot, const std::string& name, const std::string& key,
                      const std::string& text) {
  genom::Settings settings({{key, text, "robot.yaml", 12}});
  try {
    derive_settings(robot, module(name, name), settings);
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "none";
}

TEST(RobotOutline, IsADiscForACylinderAndTheCornersOfABoxAboutTheRobotsOrigin) {
  world::Shape cylinder;
  cylinder.kind = world::Shape::Kind::cylinder;
  cylinder.radius_m = 0.26;
  EXPECT_EQ(robot_outline(cylinder).radius_m, 0.26);
  EXPECT_TRUE(robot_outline(cylinder).corners.empty());
  const RobotOutline outline = robot_outline(box(0.8, 0.6, 0.1));
  ASSERT_EQ(outline.corners.size(), 4u);
  EXPECT_NEAR(outline.radius_m, exact::hypot(0.5, 0.3), 1e-12);
  for (std::size_t i = 0; i < 4; ++i)  // counter-clockwise
    EXPECT_GT(cross(outline.corners[i] - Point{0.1, 0}, outline.corners[(i + 1) % 4] - outline.corners[i]), 0);
}

TEST(DerivedSettings, NddGetsTheRobotsOutline) {
  const scenario::RobotScenario robot = robot_with_laser_at({});
  genom::Settings settings;
  derive_settings(robot, module("ndd", "ndd"), settings);
  EXPECT_NEAR(number(settings, "robot_radius_m"), 0.5 * exact::hypot(0.42, 0.43), 1e-12);
  EXPECT_NEAR(std::abs(number(settings, "footprint.0.x")), 0.21, 1e-12);
  EXPECT_NEAR(std::abs(number(settings, "footprint.3.y")), 0.215, 1e-12);
}

TEST(DerivedSettings, SickGetsTheMountOfItsConnectedLaser) {
  const scenario::RobotScenario robot = robot_with_laser_at({0.2, -0.1, exact::pi / 2});
  genom::Settings settings;
  derive_settings(robot, module("sick", "sick"), settings);
  EXPECT_EQ(number(settings, "mount_x_m"), 0.2);
  EXPECT_EQ(number(settings, "mount_y_m"), -0.1);
  EXPECT_NEAR(number(settings, "mount_heading_deg"), 90, 1e-9);
  genom::Settings other;
  derive_settings(robot, module("rear", "sick"), other);
  EXPECT_FALSE(other.has("mount_x_m"));
}

TEST(DerivedSettings, NeedNotBeReadByTheModule) {
  genom::Settings settings;
  derive_settings(robot_with_laser_at({}), module("ndd", "ndd"), settings);
  settings.check_all_used();
}

TEST(DerivedSettings, RefuseAContradictionAtItsLineAndAcceptTheSame) {
  const scenario::RobotScenario robot = robot_with_laser_at({0.2, 0, 0});
  EXPECT_EQ(complaint(robot, "sick", "mount_x_m", "0.20"), "none");
  EXPECT_EQ(complaint(robot, "sick", "mount_x_m", "0.1"),
            "robot.yaml:12: expected 'mount_x_m' to be 0.2 by the mount of 'front', or left out, found '0.1'");
  EXPECT_NE(complaint(robot, "ndd", "robot_radius_m", "0.26").find("by the robot's shape"), std::string::npos);
  EXPECT_NE(complaint(robot, "ndd", "footprint.4.x", "1").find("has 4 corners"), std::string::npos);
}

}  // namespace
}  // namespace waitpoint::bridge
