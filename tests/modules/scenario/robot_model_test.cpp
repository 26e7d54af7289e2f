// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/robot_model.hpp"

#include "tests/modules/scenario/bad_case.hpp"

namespace waitpoint::scenario {
namespace {

constexpr const char* rover = R"(<robot name="rover">
  <link name="base"><collision><geometry><box size="0.6 0.4 0.2"/></geometry></collision></link>
  <link name="mast"/>
  <link name="tilted"/>
  <link name="hanging"/>
  <joint name="a" type="fixed"><parent link="base"/><child link="mast"/><origin xyz="0.2 0 0.3" rpy="0 0 0.5"/></joint>
  <joint name="b" type="fixed"><parent link="base"/><child link="tilted"/><origin rpy="0 0.3 0"/></joint>
  <joint name="c" type="fixed"><parent link="base"/><child link="hanging"/>
    <origin xyz="0.1 0 0.3" rpy="3.141592653589793 0 0"/></joint>
</robot>)";

const std::string own_shape = "shape: {radius_m: 0.26, height_m: 1.2}";
const std::string own_mount = "mount: [0.1, 0, 0]";

class RobotModelOfAScenario : public ::testing::Test {
 protected:
  RobotModelOfAScenario() { folder_.write("rover.urdf", rover); }
  Scenario read(const std::string& laser) const {
    std::string text = changed(own_shape, "urdf: rover.urdf");
    return read_scenario(folder_.write("s.yaml", text.replace(text.find(own_mount), own_mount.size(), laser)));
  }
  std::string complaint(const std::string& laser) const {
    return message_of<BadInput>([&] { read(laser); });
  }
  TemporaryFolder folder_;
};

TEST_F(RobotModelOfAScenario, GivesShapeAndLaserMounts) {
  const world::BodyDescription body = read("frame: mast").robots.at(0).body;
  EXPECT_EQ(body.shape.kind, world::Shape::Kind::box);
  EXPECT_EQ(body.shape.length_m, 0.6);
  EXPECT_EQ(body.shape.z_low_m, 0);
  const world::LaserDescription& laser = body.sensors<world::Lasers>().at(0);
  EXPECT_NEAR(laser.mount.x, 0.2, 1e-12);
  EXPECT_NEAR(laser.mount.heading, 0.5, 1e-12);
  EXPECT_NEAR(laser.height_m, 0.4, 1e-12);  // the body stands on the floor, not in it
}

TEST_F(RobotModelOfAScenario, LaserUpsideDownIsMountedAsAnUprightOne) {
  const world::LaserDescription laser = read("frame: hanging").robots.at(0).body.sensors<world::Lasers>().at(0);
  EXPECT_NEAR(laser.mount.x, 0.1, 1e-12);
  EXPECT_NEAR(laser.mount.heading, 0, 1e-12);
}

TEST_F(RobotModelOfAScenario, TakesXacroArguments) {
  folder_.write("rover.urdf", R"(<robot name="rover">
    <link name="${namespace}base"><collision><geometry><box size="${length} 0.4 0.2"/></geometry></collision></link>
    </robot>)");
  const auto read_with = [&](const std::string& arguments) {
    std::string text = changed(own_shape, "urdf: {file: rover.urdf, arguments: " + arguments + "}");
    text.replace(text.find(own_mount), own_mount.size(), "frame: base");
    return read_scenario(folder_.write("s.yaml", text)).robots.at(0).body.shape.length_m;
  };
  EXPECT_EQ(read_with("{namespace: '', length: 0.7}"), 0.7);
  EXPECT_EQ(read_with("{namespace: , length: 0.8}"), 0.8) << "an empty value";
  EXPECT_NE(
      message_of<BadInput>([&] { read_with("{namespace: [a], length: 1}"); }).find("expected namespace to be a text"),
      std::string::npos);
  EXPECT_NE(message_of<BadInput>([&] { read_with("[a]"); }).find("expected arguments to be a map"), std::string::npos);
}

TEST_F(RobotModelOfAScenario, ContradictionsAreReportedInOneLine) {
  EXPECT_NE(complaint("frame: mst").find("there is no link 'mst' in the urdf, did you mean 'mast'?"), std::string::npos)
      << complaint("frame: mst");
  EXPECT_NE(complaint("frame: tilted").find("expected link 'tilted' to be level"), std::string::npos);
  EXPECT_NE(complaint("frame: mast, height_m: 0.4").find("expected either frame or height_m"), std::string::npos);
  const auto file = folder_.write("s.yaml", changed(own_mount, "frame: mast"));
  EXPECT_NE(message_of<BadInput>([&] { read_scenario(file); }).find("expected no frame: the robot has no urdf"),
            std::string::npos);
  const auto both = folder_.write("s.yaml", changed(own_shape, own_shape + "\n    urdf: rover.urdf"));
  EXPECT_NE(message_of<BadInput>([&] { read_scenario(both); }).find("to have either shape or urdf"), std::string::npos)
      << message_of<BadInput>([&] { read_scenario(both); });
  const auto missing = folder_.write("s.yaml", changed(own_shape, "urdf: none.urdf"));
  EXPECT_NE(message_of<BadInput>([&] { read_scenario(missing); }).find("none.urdf"), std::string::npos);
}

}  // namespace
}  // namespace waitpoint::scenario
