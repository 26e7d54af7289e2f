// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/sdf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "tests/project.hpp"
#include "tests/world/formats/files.hpp"
#include "world/formats/upright.hpp"
#include "world/formats/world_file.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::world {
namespace {

struct Read {
  std::vector<Obstacle> obstacles;
  std::vector<std::string> warnings;
};

Read parsed(const std::string& text, const std::string& file = "a.world") {
  LeftOut left_out;
  Read read;
  read.obstacles = parse_sdf(text, file, left_out).obstacles;
  read.warnings = left_out.warnings();
  return read;
}

std::string world(const std::string& inside) {
  return "<sdf version='1.6'><world name='w'>\n" + inside + "</world></sdf>";
}

std::string model(const std::string& geometry, const std::string& pose = "0 0 0 0 0 0", const std::string& name = "m") {
  return "<model name='" + name + "'><static>1</static><pose>" + pose +
         "</pose><link name='l'><collision name='c'><geometry>" + geometry + "</geometry></collision></link></model>\n";
}

const std::string plank = "<box><size>2 1 0.5</size></box>";
const std::string post = "<cylinder><radius>0.25</radius><length>2</length></cylinder>";

testing::AssertionResult refuses(const std::string& text, const std::string& where, const std::string& what) {
  return complains([&] { parsed(text); }, where, what);
}

TEST(Sdf, SolidsStandWhereTheirPosesPutThem) {
  const Read read = parsed(world(model(plank, "1 2 0.25 0 0 0.5", "plank") + model(post, "-3 4 1 0 0 0", "post")));
  ASSERT_EQ(read.obstacles.size(), 2u);
  const Shape& box = read.obstacles[0].shape;
  EXPECT_EQ(read.obstacles[0].name, "plank");
  EXPECT_EQ(box.kind, Shape::Kind::box);
  EXPECT_EQ(box.pose.x, 1);
  EXPECT_EQ(box.pose.y, 2);
  EXPECT_NEAR(box.pose.heading, 0.5, 1e-15);
  EXPECT_EQ(box.length_m, 2);
  EXPECT_EQ(box.width_m, 1);
  EXPECT_EQ(box.z_low_m, 0);
  EXPECT_EQ(box.z_high_m, 0.5);
  const Shape& cylinder = read.obstacles[1].shape;
  EXPECT_EQ(cylinder.kind, Shape::Kind::cylinder);
  EXPECT_EQ(cylinder.pose.position(), (Point{-3, 4}));
  EXPECT_EQ(cylinder.radius_m, 0.25);
  EXPECT_EQ(cylinder.z_low_m, 0);
  EXPECT_EQ(cylinder.z_high_m, 2);
  EXPECT_TRUE(read.warnings.empty());
}

TEST(Sdf, PosesOfModelLinkAndCollisionAreComposed) {
  const Read read =
      parsed(world("<model name='m'><static>true</static><pose>10 0 0 0 0 1.5707963267948966</pose>"
                   "<link name='l'><pose>2 0 1 0 0 0</pose><collision name='c'><pose>0 -1 0 0 0 "
                   "1.5707963267948966</pose><geometry>" +
                   plank + "</geometry></collision><collision name='d'><geometry>" + post +
                   "</geometry></collision></link></model>"));
  ASSERT_EQ(read.obstacles.size(), 2u);
  EXPECT_NEAR(read.obstacles[0].shape.pose.x, 11, 1e-12);
  EXPECT_NEAR(read.obstacles[0].shape.pose.y, 2, 1e-12);
  EXPECT_NEAR(std::fabs(read.obstacles[0].shape.pose.heading), exact::pi, 1e-12);
  EXPECT_NEAR(read.obstacles[0].shape.z_low_m, 0.75, 1e-12);
  EXPECT_EQ(read.obstacles[1].name, "m 1");
  EXPECT_NEAR(read.obstacles[1].shape.pose.x, 10, 1e-12);
}

TEST(Sdf, ABoxOnItsSideAndACylinderOnItsHeadAreExact) {
  const Read read =
      parsed(world(model(plank, "0 0 1 1.5707963267948966 0 0") + model(plank, "0 0 1 0 1.5707963267948966 0") +
                   model(post, "0 0 1 3.141592653589793 0 0")));
  ASSERT_EQ(read.obstacles.size(), 3u);
  EXPECT_NEAR(read.obstacles[0].shape.z_high_m, 1.5, 1e-12) << "its width upwards";
  EXPECT_NEAR(read.obstacles[0].shape.length_m * read.obstacles[0].shape.width_m, 1, 1e-12);
  EXPECT_NEAR(read.obstacles[1].shape.z_high_m, 2, 1e-12) << "its length upwards";
  EXPECT_EQ(read.obstacles[2].shape.kind, Shape::Kind::cylinder);
  EXPECT_TRUE(read.warnings.empty());
}

TEST(Sdf, ReplacesTiltedShapesByUprightBoxesAndReportsThem) {
  const Read read = parsed(world(model(plank, "1 2 1 0 0.6 0.5") + model(post, "0 0 1 0 1.5707963267948966 0") +
                                 model("<sphere><radius>0.5</radius></sphere>", "4 0 0.5 0 0 0")));
  ASSERT_EQ(read.obstacles.size(), 3u);
  const Shape& ramp = read.obstacles[0].shape;
  EXPECT_NEAR(ramp.pose.heading, 0.5, 1e-12);
  EXPECT_NEAR(ramp.length_m, 2 * std::cos(0.6) + 0.5 * std::sin(0.6), 1e-12);
  EXPECT_NEAR(ramp.width_m, 1, 1e-12);
  EXPECT_NEAR(ramp.z_high_m - ramp.z_low_m, 2 * std::sin(0.6) + 0.5 * std::cos(0.6), 1e-12);
  const Shape& log = read.obstacles[1].shape;
  EXPECT_EQ(log.kind, Shape::Kind::box);
  EXPECT_NEAR(log.length_m, 2, 1e-6);
  EXPECT_NEAR(log.width_m, 0.5, 1e-12);
  EXPECT_NEAR(log.z_low_m, 0.75, 1e-6);
  const Shape& ball = read.obstacles[2].shape;
  EXPECT_EQ(ball.kind, Shape::Kind::cylinder);
  EXPECT_EQ(ball.radius_m, 0.5);
  EXPECT_EQ(ball.z_high_m, 1);
  EXPECT_EQ(read.warnings,
            (std::vector<std::string>{"a.world:2: a tilted <box> is taken as the upright box about it",
                                      "a.world:3: a tilted <cylinder> is taken as the upright box about it",
                                      "a.world:4: a <sphere> is taken as the upright cylinder about it"}));
}

TEST(Sdf, APoseMayBeInDegrees) {
  const Read read =
      parsed(world("<model name='m'><static>1</static><pose degrees='true'>1 2 0 0 0 90</pose><link name='l'>"
                   "<collision name='c'><geometry>" +
                   plank + "</geometry></collision></link></model>"));
  EXPECT_NEAR(read.obstacles.at(0).shape.pose.heading, std::acos(0), 1e-12);
}

TEST(Sdf, NoPointOfATiltedSolidIsOutsideItsUprightShape) {
  for (int i = 0; i < 200; ++i) {
    const double roll = 0.31 * i, pitch = 0.17 * i, yaw = 0.23 * i;
    const SpacePose pose = space_pose({1, -2, 3}, roll, pitch, yaw);
    const UprightSolid box = upright_box(pose, {2, 1, 0.5}), cylinder = upright_cylinder(pose, 0.3, 2);
    for (const double x : {-1.0, 1.0})
      for (const double y : {-0.5, 0.5})
        for (const double z : {-0.25, 0.25}) {
          const SpaceVector p = pose.position + pose.turned({x, y, z});
          const Point in_box = outline_of(box.shape).local({p.x, p.y});
          EXPECT_LE(std::fabs(in_box.x), 0.5 * box.shape.length_m + 3e-4);
          EXPECT_LE(std::fabs(in_box.y), 0.5 * box.shape.width_m + 3e-4);
          EXPECT_LE(p.z, box.shape.z_high_m + 3e-4);
        }
    if (cylinder.exact) continue;
    for (int k = 0; k < 32; ++k) {
      const SpaceVector p =
          pose.position + pose.turned({0.3 * std::cos(0.2 * k), 0.3 * std::sin(0.2 * k), k % 2 == 0 ? 1.0 : -1.0});
      const Point in_box = outline_of(cylinder.shape).local({p.x, p.y});
      EXPECT_LE(std::fabs(in_box.x), 0.5 * cylinder.shape.length_m + 1e-9);
      EXPECT_LE(std::fabs(in_box.y), 0.5 * cylinder.shape.width_m + 1e-9);
      EXPECT_LE(p.z, cylinder.shape.z_high_m + 1e-9);
      EXPECT_GE(p.z, cylinder.shape.z_low_m - 1e-9);
    }
  }
}

TEST(Sdf, ReportsEachIgnoredKindOnce) {
  const std::string visual = "<visual name='v'/>";
  const Read read = parsed(
      world("<light name='sun'/>\n<model name='ground'><static>1</static><link name='l'>" + visual +
            "<collision name='c'><geometry><plane><normal>0 0 1</normal></plane></geometry>"
            "</collision></link></model>\n<model name='moves'><link name='l'>" +
            visual + "<collision name='c'><surface/><geometry>" + post + "</geometry></collision></link></model>\n" +
            model("<mesh><uri>model://chair.dae</uri></mesh>") + model(post, "0 0 -3 0 0 0") +
            "<model name='p'><pose relative_to='ground'>1 0 0 0 0 0</pose></model>\n"));
  EXPECT_EQ(read.obstacles.size(), 1u);
  EXPECT_EQ(read.warnings,
            (std::vector<std::string>{"a.world:2: <light> is left out", "a.world:3: <visual> is left out (2 times)",
                                      "a.world:3: a level <plane> is left out: robots drive on the floor, at height 0",
                                      "a.world:4: <surface> is left out",
                                      "a.world:4: a model that is not <static> is fixed here",
                                      "a.world:5: the <mesh> 'model://chair.dae' is left out: there is no such file",
                                      "a.world:6: an obstacle below the floor is left out",
                                      "a.world:7: an element with a <pose> in a named frame is left out"}));
}

TEST(Sdf, ModelsAreIncluded) {
  const Folder folder;
  std::filesystem::create_directories(folder.path("models/table"));
  folder.write("models/table/model.sdf", "<sdf version='1.5'>" + model(post, "1 0 1 0 0 0", "table") + "</sdf>");
  folder.write("wall.sdf", "<sdf version='1.5'>" + model(plank, "0 0 0 0 0 0", "wall") + "</sdf>");
  const Read read =
      parsed(world("<include><uri>model://sun</uri></include><include><uri>model://table</uri><name>t1</name>"
                   "<pose>5 0 0 0 0 3.141592653589793</pose></include><include><uri>file://wall.sdf</uri></include>"),
             folder.path("a.world"));
  ASSERT_EQ(read.obstacles.size(), 2u);
  EXPECT_EQ(read.obstacles[0].name, "t1");
  EXPECT_NEAR(read.obstacles[0].shape.pose.x, 4, 1e-12);
  EXPECT_EQ(read.obstacles[1].name, "wall");
  EXPECT_EQ(read.warnings, std::vector<std::string>{folder.path("a.world") + ":2: 'model://sun' is left out"});
}

TEST(Sdf, ModelsThatAreNotOnThisMachineAreLeftOutAndTold) {
  const Read read =
      parsed(world("<include><uri>model://chair</uri></include>\n"
                   "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Bed</uri></include>\n"
                   "<include><uri>model://chair</uri><pose>1 0 0 0 0 0</pose></include>\n" +
                   model(post)));
  EXPECT_EQ(read.obstacles.size(), 1u);
  EXPECT_EQ(
      read.warnings,
      (std::vector<std::string>{
          "a.world:2: 'model://chair' is left out: it is not beside the file, in 'models' or in '../models' (2 times)",
          "a.world:3: 'https://fuel.gazebosim.org/1.0/OpenRobotics/models/Bed' is left out: only files are read"}));
}

TEST(Sdf, AnIncludeOfItselfOrOfNothingIsRefused) {
  const Folder folder;
  const std::string text = world("\n<include><uri>a.world</uri></include>");
  const std::string file = folder.write("a.world", text);
  EXPECT_TRUE(complains([&] { parsed(text, file); }, file + ":3: ", "includes itself"));
  const std::string b = folder.write("b.sdf", "<sdf><include><uri>c.sdf</uri></include></sdf>");
  const std::string c = folder.write("c.sdf", "<sdf><include><uri>./b.sdf</uri></include></sdf>");
  EXPECT_TRUE(complains([&] { read_world_file(b, 2); }, c + ":1: ", "includes itself"));
  EXPECT_TRUE(complains([&] { parsed(world("<include><uri>d.sdf</uri></include>"), file); },
                        file + ":2: ", "there is no file"));
  EXPECT_TRUE(refuses(world("<include/>"), "a.world:2: ", "expected <uri> in <include>"));
}

TEST(Sdf, IncludesThatMultiplyEndSoon) {
  const Folder folder;
  std::string twice;
  for (int i = 0; i < 14; ++i) {
    const std::string next = "<include><uri>f" + std::to_string(i + 1) + ".sdf</uri></include>";
    folder.write("f" + std::to_string(i) + ".sdf", "<sdf>" + next + next + "</sdf>");
  }
  folder.write("f14.sdf", "<sdf/>");
  EXPECT_TRUE(complains([&] { read_world_file(folder.path("f0.sdf"), 2); }, folder.path("f"),
                        "expected at most 1000 included files"));
}

TEST(Sdf, WrongValuesAreNamedByLine) {
  EXPECT_TRUE(refuses("", "a.world:1: ", "expected XML"));
  EXPECT_TRUE(refuses("<sdf><world></sdf>", "a.world:1: ", "XML_ERROR_MISMATCHED_ELEMENT"));
  EXPECT_TRUE(refuses(world(model(plank)).substr(0, 150), "a.world:", "expected XML"));
  EXPECT_TRUE(refuses(world("") + '\0', "a.world:1: ", "zero byte"));
  EXPECT_TRUE(refuses("<gazebo/>", "a.world:1: ", "expected the outermost element to be <sdf>"));
  EXPECT_TRUE(refuses(world(model(plank, "0 0 0 0 nan 0")), "a.world:2: ", "6 numbers within 100 km in <pose>"));
  EXPECT_TRUE(refuses(world(model(plank, "0 0 0 0 0")), "a.world:2: ", "6 numbers"));
  EXPECT_TRUE(refuses(world(model(plank, "0 0 0 0 0 0 0")), "a.world:2: ", "6 numbers"));
  EXPECT_TRUE(refuses(world(model(plank, "1e9 0 0 0 0 0")), "a.world:2: ", "within 100 km"));
  EXPECT_TRUE(refuses(world(model(plank, "0 0 0 0 0 99999")), "a.world:2: ", "angles in radians"));
  EXPECT_TRUE(refuses(world("\n" + model("<box><size>1 0 1</size></box>")), "a.world:3: ", "<size> to be positive"));
  EXPECT_TRUE(refuses(world(model("<box/>")), "a.world:2: ", "expected <size> in <box>"));
  EXPECT_TRUE(refuses(world(model("<sphere><radius>-1</radius></sphere>")), "a.world:2: ", "positive"));
  EXPECT_TRUE(
      refuses(world(model("<cylinder><radius>inf</radius><length>1</length></cylinder>")), "a.world:2: ", "1 number"));
  EXPECT_TRUE(refuses(world("<model><static>perhaps</static></model>"), "a.world:2: ", "<static> to be true or false"));
  EXPECT_TRUE(refuses(world(model("")), "a.world:2: ", "expected a shape in <geometry>"));
}

TEST(Sdf, NestedDeeplyIsRefused) {
  std::string text = "<sdf>";
  for (int i = 0; i < 100000; ++i) text += "<model>";
  EXPECT_TRUE(refuses(text, "a.world:1: ", "XML_ELEMENT_DEPTH_EXCEEDED"));
}

TEST(Sdf, WorldsOfTheBarnBenchmarkAreRead) {
  const std::optional<std::string> data = test::data_folder();
  if (!data) GTEST_SKIP() << "no data folder: set WAITPOINT_DATA";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*data + "/barn")) {
    if (entry.path().extension() != ".world") continue;
    const WorldFile world = read_world_file(entry.path().string(), 2);
    EXPECT_GT(world.obstacles.size(), 100u) << entry.path();
    for (const Obstacle& obstacle : world.obstacles) {
      EXPECT_EQ(obstacle.shape.kind, Shape::Kind::cylinder);
      EXPECT_EQ(obstacle.shape.radius_m, 0.075);
    }
    EXPECT_TRUE(world.has_heights);
    for (const std::string& warning : world.warnings) EXPECT_EQ(warning.find('\n'), std::string::npos);
    EXPECT_LT(world.warnings.size(), 40u);
    ++files;
  }
  EXPECT_EQ(files, 12);
}

// 2 m by 1 m, upright, along x.
const std::string upright_stl = "solid s\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 0 1\nendloop\nendsolid\n";

TEST(Sdf, MeshesStandWhereTheirPosesPutThem) {
  const Folder folder;
  std::filesystem::create_directories(folder.path("models/chair/meshes"));
  folder.write("models/chair/meshes/seat.stl", upright_stl);
  folder.write("models/chair/model.sdf",
               "<sdf version='1.6'>" +
                   model("<mesh><uri>model://chair/meshes/seat.stl</uri><scale>2 1 1</scale></mesh>", "1 0 0 0 0 0") +
                   "</sdf>");
  folder.write("bare.STL", upright_stl);
  const std::string file = folder.path("a.world");
  LeftOut left_out;
  const SdfWorld read = parse_sdf(world(model("<mesh><uri>bare.STL</uri></mesh>", "0 0 0.5 0 0 0", "wall") +
                                        "<include><uri>model://chair</uri><name>left chair</name><pose>10 0 0 0 0 "
                                        "1.5707963267948966</pose></include>" +
                                        model("<mesh><uri>bare.STL</uri></mesh>", "0 0 -2 0 0 0") +
                                        model("<mesh><uri>bare.STL</uri><submesh><name>a</name></submesh></mesh>")),
                                  file, left_out);
  EXPECT_TRUE(read.obstacles.empty());
  ASSERT_EQ(read.meshes.size(), 2u);
  EXPECT_EQ(read.meshes[0].name, "wall");
  EXPECT_EQ(read.meshes[0].mesh->corners[1].x, 2);
  EXPECT_EQ(read.meshes[0].mesh->corners[2].z, 1.5);
  EXPECT_EQ(read.meshes[1].name, "left chair");
  EXPECT_NEAR(read.meshes[1].mesh->corners[1].x, 10, 1e-12);
  EXPECT_NEAR(read.meshes[1].mesh->corners[1].y, 5, 1e-12);
  const std::vector<std::string> warnings = left_out.warnings();
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("an obstacle below the floor is left out"), std::string::npos);
  EXPECT_NE(warnings[1].find("a <mesh> with a <submesh> is left out"), std::string::npos);
}

TEST(Sdf, AMeshThatIsBadIsAnErrorOfItsOwnFile) {
  const Folder folder;
  const std::string stl = folder.write("bad.stl", "solid s\nvertex\n");
  const std::string file = folder.path("a.world");
  const auto read = [&](const std::string& inside) {
    LeftOut left_out;
    parse_sdf(world(model("<mesh>" + inside + "</mesh>")), file, left_out);
  };
  EXPECT_TRUE(complains([&] { read("<uri>bad.stl</uri>"); }, stl + ":2: ", "expected STL"));
  EXPECT_TRUE(complains([&] { read("<uri>bad.stl</uri><scale>1 0 1</scale>"); }, file + ":2: ", "not to be zero"));
  EXPECT_TRUE(complains([&] { read("<scale>1 1 1</scale>"); }, file + ":2: ", "expected <uri> in <mesh>"));
}

}  // namespace
}  // namespace waitpoint::world
