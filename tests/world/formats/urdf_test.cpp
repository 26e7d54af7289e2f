// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/urdf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tests/world/formats/files.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::world {
namespace {

struct ReadRobot {
  UrdfRobot robot;
  std::vector<std::string> warnings;
};

ReadRobot robot_of(const std::string& inside) {
  LeftOut left_out;
  ReadRobot read;
  read.robot = parse_urdf("<robot name='r'>\n" + inside + "</robot>", "r.urdf", left_out);
  read.warnings = left_out.warnings();
  return read;
}

std::string link(const std::string& name, const std::string& inside = "") {
  return "<link name='" + name + "'>" + inside + "</link>\n";
}
std::string collision(const std::string& shape, const std::string& origin = "") {
  return "<collision>" + origin + "<geometry>" + shape + "</geometry></collision>";
}
std::string joint(const std::string& parent, const std::string& child, const std::string& origin = "",
                  const std::string& type = "fixed") {
  return "<joint name='" + child + "_joint' type='" + type + "'><parent link='" + parent + "'/><child link='" + child +
         "'/>" + origin + "</joint>\n";
}
const std::string hull = "<cylinder radius='0.2' length='0.3'/>";

testing::AssertionResult rejects_urdf(const std::string& inside, const std::string& where, const std::string& what) {
  return complains([&] { robot_of(inside); }, where, what);
}

TEST(Urdf, OneUprightSolidIsTheShape) {
  const ReadRobot read = robot_of(link("base", collision(hull, "<origin xyz='0.1 0 0.2'/>")));
  EXPECT_EQ(read.robot.name, "r");
  EXPECT_EQ(read.robot.shape.kind, Shape::Kind::cylinder);
  EXPECT_EQ(read.robot.shape.pose.position(), (Point{0.1, 0}));
  EXPECT_EQ(read.robot.shape.radius_m, 0.2);
  EXPECT_NEAR(read.robot.shape.z_low_m, 0.05, 1e-15);
  EXPECT_NEAR(read.robot.shape.z_high_m, 0.35, 1e-15);
  EXPECT_TRUE(read.warnings.empty());
}

// The robot of the figures: a hull, two wheels beside it, a laser on a mast.
TEST(Urdf, SeveralSolidsAreTakenTogetherAndFramesFollowTheJoints) {
  const ReadRobot read = robot_of(
      link("base", collision("<box size='0.6 0.4 0.2'/>")) +
      link("left", collision("<cylinder radius='0.1' length='0.05'/>", "<origin rpy='1.5707963267948966 0 0'/>")) +
      link("mast") + link("laser") + joint("base", "left", "<origin xyz='0 0.225 -0.1'/>", "continuous") +
      joint("mast", "laser", "<origin xyz='0.1 0 0.3'/>") +
      joint("base", "mast", "<origin xyz='0.2 0 0.1' rpy='0 0 1.5707963267948966'/>"));
  const Shape& shape = read.robot.shape;
  EXPECT_EQ(shape.kind, Shape::Kind::box);
  EXPECT_NEAR(shape.length_m, 0.6, 1e-12);
  EXPECT_NEAR(shape.width_m, 0.45, 1e-12);  // from the hull's right side to the wheel's outer one
  EXPECT_NEAR(shape.pose.y, 0.025, 1e-12);
  EXPECT_NEAR(shape.z_low_m, 0, 1e-12);  // the wheel stands on the floor
  EXPECT_NEAR(shape.z_high_m, 0.3, 1e-12);
  ASSERT_EQ(read.robot.frames.size(), 4u);
  EXPECT_EQ(read.robot.frames[0].link, "base");
  EXPECT_NEAR(read.robot.frames[0].pose.position.z, 0.2, 1e-12);
  const UrdfFrame& laser = read.robot.frames[3];
  EXPECT_EQ(laser.link, "laser");
  EXPECT_NEAR(laser.pose.position.x, 0.2, 1e-12);
  EXPECT_NEAR(laser.pose.position.y, 0.1, 1e-12);  // the mast is turned
  EXPECT_NEAR(laser.pose.position.z, 0.6, 1e-12);
  EXPECT_NEAR(laser.pose.axes[0].y, 1, 1e-12);
  ASSERT_EQ(read.warnings.size(), 2u);
  EXPECT_EQ(read.warnings[0], "r.urdf:6: a <joint> that is not fixed is held at 0");
  EXPECT_EQ(read.warnings[1], "r.urdf:1: a <robot> of several solids is taken as the upright box about them");
}

// A hull with an arm across its front: neither the box nor the cylinder about them is tight.
TEST(Urdf, SeveralSolidsAreThePrismAboutThemWhereThatIsMuchTighter) {
  const ReadRobot read =
      robot_of(link("base", collision("<cylinder radius='0.2' length='0.4'/>", "<origin xyz='-0.5 0 0'/>")) +
               link("arm", collision("<box size='0.1 1 0.2'/>", "<origin xyz='0.4 0 0.3'/>")) + joint("base", "arm"));
  const Shape& shape = read.robot.shape;
  ASSERT_EQ(shape.kind, Shape::Kind::prism);
  EXPECT_NEAR(shape.z_low_m, 0, 1e-12);
  EXPECT_NEAR(shape.z_high_m, 0.6, 1e-12);
  const Outline outline = outline_of(shape);
  const Bounds bounds = bounds_of(outline);
  EXPECT_NEAR(bounds.high.x, 0.45, 1e-9);
  EXPECT_NEAR(bounds.high.y, 0.5, 1e-9);
  EXPECT_NEAR(bounds.low.x, -0.7, 0.009 * 0.2);
  const auto is_inside = [&](Point p) {
    const Point local = outline.local(p);
    const auto sides = shape.polygon->sides();
    return std::all_of(sides.begin(), sides.end(),
                       [&](const auto& side) { return dot(side.outward, local) <= side.beyond_m; });
  };
  for (int i = 0; i < 360; ++i) {
    const double angle = i * exact::pi / 180;
    EXPECT_TRUE(is_inside({-0.5 + 0.2 * std::cos(angle), 0.2 * std::sin(angle)})) << i;
  }
  EXPECT_TRUE(is_inside({0.449, 0.499}));
  EXPECT_FALSE(is_inside({-0.3, 0.4})) << "in the box about them, and not between them";
  EXPECT_EQ(
      read.warnings,
      (std::vector<std::string>{
          "r.urdf:1: a <robot> of several solids is taken as the upright prism over the convex outline of them"}));
}

TEST(Urdf, ARoundRobotStaysRound) {
  const ReadRobot read =
      robot_of(link("base", collision(hull) + collision("<sphere radius='0.05'/>", "<origin xyz='-0.15 0 -0.15'/>")));
  EXPECT_EQ(read.robot.shape.kind, Shape::Kind::cylinder);
  EXPECT_NEAR(read.robot.shape.radius_m, 0.2, 1e-12);
  EXPECT_NEAR(read.robot.shape.z_high_m, 0.35, 1e-12);
}

TEST(Urdf, ReportsUnknownElements) {
  const ReadRobot read = robot_of("<material name='m'/>\n" + link("base", "<visual/><inertial/>" + collision(hull)) +
                                  link("arm", "\n" + collision("<mesh filename='arm.stl'/>")) + joint("base", "arm"));
  ASSERT_EQ(read.warnings.size(), 4u);
  EXPECT_EQ(read.warnings[0], "r.urdf:2: <material> is left out");
  EXPECT_EQ(read.warnings[1], "r.urdf:3: <visual> is left out");
  EXPECT_EQ(read.warnings[3], "r.urdf:5: the <mesh> 'arm.stl' is left out: there is no such file");
}

TEST(Urdf, ARobotWithoutCollisionHasTheShapeOfItsVisual) {
  const ReadRobot read =
      robot_of(link("base", "<visual><origin xyz='0.1 0 0.2'/><geometry>" + hull + "</geometry></visual>"));
  EXPECT_EQ(read.robot.shape.pose.position(), (Point{0.1, 0}));
  EXPECT_EQ(read.robot.shape.radius_m, 0.2);
  EXPECT_EQ(read.warnings.back(), "r.urdf:1: a <robot> without <collision> has the shape of its <visual>");
}

TEST(Urdf, ArgumentsOfXacroStandForTheirValues) {
  const std::string text =
      "<robot name='r'>\n<xacro:arg name='mast' default='mast'/><xacro:property name='radius' value='0.2'/>\n" +
      link("${namespace}base", collision("<cylinder radius='${radius}' length='0.3'/>")) + link("$(arg mast)") +
      joint("${namespace}base", "$(arg mast)") + "<gazebo reference='${2 * radius}'/></robot>";
  const auto read = [&](const XacroArguments& arguments) {
    LeftOut left_out;
    ReadRobot result;
    result.robot = parse_urdf(text, "r.urdf", left_out, arguments);
    result.warnings = left_out.warnings();
    return result;
  };
  const ReadRobot given = read({{"namespace", ""}, {"mast", "a<b&\""}, {"radius", "0.25"}});
  EXPECT_EQ(given.robot.frames[0].link, "base");
  EXPECT_EQ(given.robot.frames[1].link, "a<b&\"");
  EXPECT_EQ(given.robot.shape.radius_m, 0.25);
  EXPECT_EQ(given.warnings.front(), "r.urdf:6: '${2 * radius}' remains as it is: expressions are the task of xacro");

  const ReadRobot own = read({});
  EXPECT_EQ(own.robot.frames[0].link, "${namespace}base") << "no value";
  EXPECT_EQ(own.robot.frames[1].link, "mast");
  EXPECT_EQ(own.robot.shape.radius_m, 0.2);
  EXPECT_EQ(own.warnings.front(),
            "r.urdf:3: '${namespace}' remains as it is: it has no value in the urdf's 'arguments' (2 times)");
  EXPECT_TRUE(complains([&] { read({{"namespac", "a"}}); }, "r.urdf: ", "did you mean 'namespace'?"));
}

TEST(Urdf, AFileThatNeedsXacroSaysSo) {
  EXPECT_TRUE(rejects_urdf("<xacro:include filename='base.xacro'/>", "r.urdf:1", "run xacro first"));
}

TEST(Urdf, BadInputIsOneLineAtItsPlace) {
  const std::string base = link("base", collision(hull));
  EXPECT_TRUE(rejects_urdf("", "r.urdf:1", "expected a <link>"));
  EXPECT_TRUE(rejects_urdf(link("base"), "r.urdf:1", "the robot has no geometry"));
  EXPECT_TRUE(rejects_urdf(base + base, "r.urdf:3", "'base' is there already"));
  EXPECT_TRUE(rejects_urdf(base + link("arm"), "r.urdf:3", "neither 'base' nor 'arm' is the child of a joint"));
  EXPECT_TRUE(rejects_urdf(base + joint("base", "arm"), "r.urdf:3", "expected a link of the robot, found 'arm'"));
  EXPECT_TRUE(
      rejects_urdf(base + link("a") + link("b") + joint("a", "b") + joint("b", "a"), "r.urdf:6", "found a circle"));
  EXPECT_TRUE(rejects_urdf(link("a") + joint("a", "a"), "r.urdf:2", "found a circle"));
  EXPECT_TRUE(rejects_urdf(base + link("a") + joint("base", "a") + joint("base", "a"), "r.urdf:5", "'a' has two"));
  EXPECT_TRUE(rejects_urdf(link("a", collision("<box size='1 2'/>")), "r.urdf:2", "expected 3 numbers within 100 km"));
  EXPECT_TRUE(rejects_urdf(link("a", collision("<box size='1 2 0'/>")), "r.urdf:2", "expected 'size' of <box>"));
  EXPECT_TRUE(rejects_urdf(link("a", collision("<cylinder radius='0.1'/>")), "r.urdf:2", "to have 'length'"));
  EXPECT_TRUE(rejects_urdf(link("a", collision("<sphere radius='nan'/>")), "r.urdf:2", "expected 1 number"));
  EXPECT_TRUE(rejects_urdf(link("a", collision(hull, "<origin rpy='90000 0 0'/>")), "r.urdf:2", "angles in radians"));
  EXPECT_TRUE(rejects_urdf(link("a", collision("<mesh filename='a.stl' scale='1 0 1'/>")), "r.urdf:2",
                           "expected 'scale' of <mesh> not to be zero"));
  EXPECT_TRUE(complains(
      [] {
        LeftOut left_out;
        parse_urdf("<sdf/>", "r.urdf", left_out);
      },
      "r.urdf:1", "expected the outermost element to be <robot>"));
}

TEST(Urdf, AMeshIsThePrismOverItsConvexOutline) {
  const Folder folder;
  std::filesystem::create_directories(folder.path("rover/meshes"));
  std::filesystem::create_directories(folder.path("rover/urdf"));
  folder.write("rover/meshes/hull.obj", "v -100 0 0\nv 300 0 0\nv 0 200 0\nv 0 0 50\nf 1 2 3\nf 1 2 4\n");
  const std::string file = folder.path("rover/urdf/r.urdf");
  for (const char* uri : {"package://rover/meshes/hull.obj", "../meshes/hull.obj"}) {
    LeftOut left_out;
    const UrdfRobot robot =
        parse_urdf("<robot name='r'>" +
                       link("base", collision("<mesh scale='0.001 0.001 0.001' filename='" + std::string(uri) + "'/>",
                                              "<origin xyz='0 0 0.1'/>")) +
                       "</robot>",
                   file, left_out);
    EXPECT_EQ(robot.shape.kind, Shape::Kind::prism);
    const CorePoints corners = core_points(outline_of(robot.shape));
    ASSERT_EQ(corners.count(), 3u);
    for (const Point corner : {Point{-0.1, 0}, Point{0.3, 0}, Point{0, 0.2}})
      EXPECT_LT(std::min({length(corners[0] - corner), length(corners[1] - corner), length(corners[2] - corner)}),
                1e-12);
    EXPECT_NEAR(robot.shape.pose.x, 0.1, 1e-12);
    EXPECT_NEAR(robot.shape.pose.y, 0.1, 1e-12);
    EXPECT_NEAR(robot.shape.length_m, 0.4, 1e-12);
    EXPECT_NEAR(robot.shape.width_m, 0.2, 1e-12);
    EXPECT_NEAR(robot.shape.z_low_m, 0.1, 1e-12);
    EXPECT_NEAR(robot.shape.z_high_m, 0.15, 1e-12);
    ASSERT_EQ(left_out.warnings().size(), 1u);
    EXPECT_NE(left_out.warnings()[0].find("a <mesh> is taken as the upright prism over its convex outline"),
              std::string::npos);
  }
}

TEST(Urdf, ATiltedMeshHasTheOutlineOfAllItsCorners) {
  const Folder folder;
  folder.write("plate.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  const auto robot = [&](const std::string& rpy) {
    LeftOut left_out;
    return parse_urdf("<robot name='r'>" +
                          link("base", collision("<mesh filename='plate.obj'/>", "<origin rpy='" + rpy + "'/>")) +
                          "</robot>",
                      folder.path("r.urdf"), left_out);
  };
  const Shape turned_up = robot("0 -0.5 0").shape;  // about the side along y
  EXPECT_EQ(turned_up.kind, Shape::Kind::prism);
  EXPECT_NEAR(turned_up.length_m, std::cos(0.5), 1e-12);
  EXPECT_NEAR(turned_up.width_m, 1, 1e-12);
  EXPECT_NEAR(turned_up.z_high_m - turned_up.z_low_m, std::sin(0.5), 1e-12);
  // A mesh of nearly no extent is a thin box.
  EXPECT_EQ(robot("0 0 0.3").shape.kind, Shape::Kind::box);
  EXPECT_EQ(robot("1.5707963267948966 0 0").shape.kind, Shape::Kind::box);
}

}  // namespace
}  // namespace waitpoint::world
