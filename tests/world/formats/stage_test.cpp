// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/stage.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/exact_math.hpp"
#include "tests/project.hpp"
#include "tests/world/formats/files.hpp"
#include "world/formats/segments.hpp"
#include "world/formats/stage_robot.hpp"
#include "world/formats/world_file.hpp"
#include "world/kinematic/start_check.hpp"

namespace waitpoint::world {
namespace {

struct ReadStage : StageWorld {
  std::vector<std::string> warnings;
};

ReadStage stage_world(const std::string& text, const std::string& file = "a.world") {
  LeftOut left_out;
  ReadStage read{parse_stage(text, file, left_out), {}};
  read.warnings = left_out.warnings();
  return read;
}

testing::AssertionResult rejects_stage(const std::string& text, const std::string& where, const std::string& what) {
  return complains([&] { stage_world(text); }, where, what);
}

double degrees(double value) { return value / 180 * exact::pi; }

TEST(Stage, AModelIsABoxOfItsSize) {
  const ReadStage read = stage_world("model( name \"desk\" pose [1 2 0.5 30] size [2 1 0.75] )\nmodel( size [1 1] )\n");
  ASSERT_EQ(read.obstacles.size(), 2u);
  EXPECT_EQ(read.obstacles[0].name, "desk");
  const Shape& desk = read.obstacles[0].shape;
  EXPECT_EQ(desk.pose, (Pose{1, 2, degrees(30)}));
  EXPECT_EQ(desk.length_m, 2);
  EXPECT_EQ(desk.width_m, 1);
  EXPECT_EQ(desk.z_low_m, 0.5);
  EXPECT_EQ(desk.z_high_m, 1.25);
  EXPECT_EQ(read.obstacles[1].name, "model");
  EXPECT_EQ(read.obstacles[1].shape.z_high_m, 0.1);
  EXPECT_TRUE(read.warnings.empty());
}

TEST(Stage, AThingHasWhatItsTypeHasWhereItGivesNoneOfItsOwn) {
  const ReadStage read = stage_world(
      "define box model ( size [1 2 3] pose [9 9 0 0] )\n"
      "define high box( size [1 2 4] )\n"
      "box( pose [1 0 0 0] )\nhigh()\nhigh( size [5 5 5] size [6 6 6] )\n");
  ASSERT_EQ(read.obstacles.size(), 3u);
  EXPECT_EQ(read.obstacles[0].shape.pose.x, 1);
  EXPECT_EQ(read.obstacles[0].shape.z_high_m, 3);
  EXPECT_EQ(read.obstacles[1].shape.pose.x, 9);
  EXPECT_EQ(read.obstacles[1].shape.z_high_m, 4);
  EXPECT_EQ(read.obstacles[2].shape.z_high_m, 6) << "the last mention counts";
}

TEST(Stage, ABitmapsDarkPixelsFillTheModel) {
  const Folder folder;
  std::filesystem::create_directories(folder.path("maps"));
  // Dark: the upper left and the two lower right ones.
  folder.write("maps/plan.pgm", std::string("P5 4 2 255\n") + '\x7f' + "\xff\xff\xff" + "\x80\xff" + '\0' + '\0');
  const ReadStage read =
      stage_world("model( name \"plan\" pose [10 0 0 90] size [8 2 0.5] bitmap \"maps/plan.pgm\" boundary 1 )",
                  folder.path("a.world"));
  ASSERT_EQ(read.obstacles.size(), 6u);
  const Shape& wide = read.obstacles[0].shape;
  EXPECT_EQ(wide.length_m, 4);
  EXPECT_EQ(wide.width_m, 1);
  EXPECT_EQ(wide.z_high_m, 0.5);
  EXPECT_NEAR(wide.pose.x, 10.5, 1e-12) << "turned by a right angle: 2 m ahead and half a metre to the right";
  EXPECT_NEAR(wide.pose.y, 2, 1e-12);
  const Shape& left = read.obstacles[1].shape;
  EXPECT_EQ(left.length_m, 2);
  EXPECT_NEAR(left.pose.x, 9.5, 1e-12);
  EXPECT_NEAR(left.pose.y, -3, 1e-12);
  EXPECT_EQ(read.obstacles[1].name, "plan 1");
  for (std::size_t i = 2; i < 6; ++i) EXPECT_EQ(read.obstacles[i].shape.width_m, wall_thickness_m);
  EXPECT_NEAR(read.obstacles[2].shape.pose.x, 11, 1e-12) << "the boundary's lower side";
  EXPECT_NEAR(read.obstacles[2].shape.length_m, 8, 1e-12);
}

TEST(Stage, BlocksFillTheModel) {
  const ReadStage read = stage_world(
      "model( size [4 2 1] block( points 4 point[0] [0 0] point[1] [0 1] point[2] [1 1] point[3] [1 0] z [0 1] )\n"
      "block( points 3 point[0] [1 0] point[1] [2 0] point[2] [2 1] z [0.5 2] ) )");
  ASSERT_EQ(read.obstacles.size(), 2u);
  EXPECT_EQ(read.obstacles[0].shape.pose, (Pose{-1, 0, 0}));
  EXPECT_EQ(read.obstacles[0].shape.length_m, 2);
  EXPECT_EQ(read.obstacles[0].shape.z_high_m, 0.5);
  EXPECT_EQ(read.obstacles[1].shape.z_low_m, 0.25);
  EXPECT_EQ(read.obstacles[1].shape.z_high_m, 1);
  EXPECT_EQ(read.warnings,
            std::vector<std::string>{"a.world:2: a 'block' that is no rectangle is taken as the box about it"});
}

TEST(Stage, SkipsModelsThatReturnNothing) {
  const ReadStage read = stage_world(
      "define zone model( obstacle_return 0 ranger_return -1 )\nzone()\nmodel( obstacle_return 0 )\n"
      "model( ranger_return -1 )\nmodel( ranger_return 0.5 )\n");
  EXPECT_EQ(read.obstacles.size(), 3u);
  EXPECT_EQ(
      read.warnings,
      (std::vector<std::string>{
          "a.world:3: an 'obstacle_return' of 0 is left out: a model that stops only bodies or only beams stops both",
          "a.world:4: a 'ranger_return' below 0 is left out: a model that stops only bodies or only beams stops "
          "both"}));
}

TEST(Stage, ModelsInAModelStandOnIt) {
  const ReadStage read =
      stage_world("model( size [1 1 0.75] pose [5 0 0 180] model( pose [0.25 0 0 0] size [0.1 0.1 0.3] ) )");
  ASSERT_EQ(read.obstacles.size(), 2u);
  EXPECT_NEAR(read.obstacles[1].shape.pose.x, 4.75, 1e-12);
  EXPECT_EQ(read.obstacles[1].shape.z_low_m, 0.75);
  EXPECT_EQ(read.obstacles[1].shape.z_high_m, 1.05);
}

TEST(Stage, APositionIsARobotWithItsLasers) {
  const ReadStage read = stage_world(
      "define sick ranger( size [0.15 0.15 0.2] sensor( pose [0.05 0 0.1 0] range [0 8] fov 180 samples 181 ) )\n"
      "define bot position( size [0.4 0.3 0.25] origin [-0.04 0 0 0] drive \"diff\"\n"
      "  velocity_bounds [-0.5 0.5 0 0 0 0 -90 90] sick( pose [0.1 0 -0.05 180] ) )\n"
      "bot( name \"one\" pose [1 2 0 45] )\nbot()\nbot()\nbot( name \"one\" )\n");
  ASSERT_EQ(read.bodies.size(), 4u);
  const BodyDescription& one = read.bodies[0];
  EXPECT_EQ(one.name, "one");
  EXPECT_EQ(read.bodies[1].name, "bot_0");
  EXPECT_EQ(read.bodies[2].name, "bot_1");
  EXPECT_EQ(read.bodies[3].name, "one_1");
  EXPECT_EQ(one.start, (Pose{1, 2, degrees(45)}));
  EXPECT_EQ(one.shape.pose, (Pose{-0.04, 0, 0}));
  EXPECT_EQ(one.shape.length_m, 0.4);
  EXPECT_EQ(one.shape.z_low_m, 0);
  EXPECT_NEAR(one.shape.z_high_m, 0.4, 1e-12) << "as high as the laser on it";
  EXPECT_EQ(one.base.kind, BaseDescription::Kind::differential);
  EXPECT_EQ(one.base.v_max_m_s, 0.5);
  EXPECT_EQ(one.base.w_max_rad_s, degrees(90));
  EXPECT_EQ(one.base.v_acceleration_m_s2, 1);
  ASSERT_EQ(one.sensors<Lasers>().size(), 1u);
  const LaserDescription& laser = one.sensors<Lasers>()[0];
  EXPECT_NEAR(laser.mount.x, 0.05, 1e-12) << "the sensor is ahead of the laser, which looks back";
  EXPECT_NEAR(laser.height_m, 0.3, 1e-12);
  EXPECT_EQ(laser.beams, 181u);
  EXPECT_EQ(laser.field_of_view_rad, exact::pi);
  EXPECT_EQ(laser.range_max_m, 8);
  EXPECT_EQ(laser.range_noise_m, 0);
  EXPECT_EQ(laser.period, Duration(std::chrono::milliseconds(100)));
  EXPECT_TRUE(read.warnings.empty());
}

TEST(Stage, SensorsOfOneSampleAtOnePlaceAreOneLaser) {
  const std::string ring = "sensor( pose [0 0 0 0] ) sensor( pose [0 0 0 120] ) sensor( pose [0 0 0 240] )";
  const LaserDescription fan = stage_world("position( ranger( " + ring + " ) )").bodies[0].sensors<Lasers>().at(0);
  EXPECT_EQ(fan.beams, 3u);
  EXPECT_NEAR(fan.field_of_view_rad, degrees(240), 1e-12);
  EXPECT_NEAR(fan.mount.heading, degrees(120), 1e-12);
  const auto lasers = [](const std::string& last) {
    return stage_world("position( ranger( sensor( ) sensor( pose [0 0 0 30] ) sensor( " + last + " ) ) )")
        .bodies[0]
        .sensors<Lasers>();
  };
  EXPECT_EQ(lasers("pose [0 0 0 60]").size(), 1u);
  EXPECT_EQ(lasers("pose [0 0 0 70]").size(), 3u) << "not evenly spaced";
  EXPECT_EQ(lasers("pose [0.1 0 0 60]").size(), 3u) << "at another place";
  EXPECT_EQ(lasers("pose [0 0 0 60] range [0 3]").size(), 3u) << "of another range";
  EXPECT_EQ(lasers("pose [0 0 0 60] samples 2 fov 10").size(), 3u);
}

TEST(Stage, RangersAndLasersOfEarlierVersionsMeanTheSame) {
  const ReadStage read = stage_world(
      "define sick laser( range_max 10 fov 90 samples 91 size [0.1 0.1 0.2] )\n"
      "define ring ranger( scount 2 spose[0] [0.1 0.2 90] spose[1] [0.1 -0.2 -90] sview [0 3 15] sview[1] [0 4 15] )\n"
      "position( sick( pose [0.05 0 0 180] ) ring() sonar( scount 1 spose[0] [0 0 0] ) laser() )\n");
  const std::vector<LaserDescription>& lasers = read.bodies.at(0).sensors<Lasers>();
  ASSERT_EQ(lasers.size(), 5u);
  EXPECT_EQ(lasers[0].beams, 91u);
  EXPECT_EQ(lasers[0].field_of_view_rad, degrees(90));
  EXPECT_EQ(lasers[0].range_max_m, 10);
  EXPECT_EQ(lasers[0].mount.x, 0.05);
  EXPECT_EQ(lasers[1].mount, (Pose{0.1, 0.2, degrees(90)}));
  EXPECT_EQ(lasers[1].range_max_m, 3);
  EXPECT_EQ(lasers[2].mount, (Pose{0.1, -0.2, degrees(-90)}));
  EXPECT_EQ(lasers[2].range_max_m, 4);
  EXPECT_EQ(lasers[3].range_max_m, 5);
  EXPECT_EQ(lasers[4].beams, 180u);
  EXPECT_EQ(lasers[4].range_max_m, 8);
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_TRUE(rejects_stage("position( ranger( scount 2 spose[0] [0 0 0] ) )", "a.world:1: ", "expected spose[1]"));
}

TEST(Stage, AMapOfEarlierVersionsIsAModel) {
  const ReadStage read = stage_world("map( name \"hall\" size [4 3] polygon[0].point[1] [1 2] )\n");
  EXPECT_EQ(read.obstacles.at(0).name, "hall");
  EXPECT_EQ(read.warnings, std::vector<std::string>{"a.world:1: 'polygon[0].point[1]' is left out"});
}

TEST(Stage, AFlatFloorPlanHasWalls) {
  const ReadStage read = stage_world("model( size [4 3 0] )\n");
  EXPECT_EQ(read.obstacles.at(0).shape.z_high_m, 2);
  EXPECT_EQ(read.warnings, std::vector<std::string>{"a.world:1: a model of height 0 is taken as 2 m high"});
  EXPECT_TRUE(rejects_stage("position( size [1 1 0] )", "a.world:1: ", "a positive height"));
}

TEST(Stage, AReturnMayBeAnyNumber) {
  EXPECT_EQ(stage_world("model( ranger_return 1000000 )").obstacles.size(), 1u);
  EXPECT_TRUE(rejects_stage("model( ranger_return bright )", "a.world:1: ", "expected a number in 'ranger_return'"));
}

TEST(Stage, ADriveIsTheBasesKind) {
  const ReadStage read = stage_world(
      "define omni position( drive \"omni\" velocity_bounds [-0.5 0.5 -0.5 0.5 0 0 -60 60] )\nomni()\n"
      "omni( velocity_bounds [-0.5 0.5 0 0 0 0 -60 60] )\nposition( drive \"diff\" )\n");
  ASSERT_EQ(read.bodies.size(), 3u);
  EXPECT_EQ(read.bodies[0].base.kind, BaseDescription::Kind::omni);
  EXPECT_EQ(read.bodies[0].base.v_max_m_s, 0.5);
  EXPECT_EQ(read.bodies[0].base.w_max_rad_s, degrees(60));
  EXPECT_EQ(read.bodies[1].base.kind, BaseDescription::Kind::omni);
  EXPECT_EQ(read.bodies[2].base.kind, BaseDescription::Kind::differential);
  EXPECT_EQ(read.warnings,
            std::vector<std::string>{"a.world:3: a sideways bound of an omni drive is taken as that along"});
}

TEST(Stage, ACarSteers) {
  const ReadStage read = stage_world(
      "define car position( drive \"car\" wheelbase 2.5 acceleration_bounds [-1 1 0 0 0 0 -40 40] )\n"
      "car( velocity_bounds [-3 3 0 0 0 0 -30 30] )\ncar( velocity_bounds [-3 3 0 0 0 0 -90 90] )\nposition( drive "
      "\"car\" )\n");
  ASSERT_EQ(read.bodies.size(), 3u);
  const BaseDescription& car = read.bodies[0].base;
  EXPECT_EQ(car.kind, BaseDescription::Kind::ackermann);
  EXPECT_EQ(car.wheelbase_m, 2.5);
  EXPECT_EQ(car.v_max_m_s, 3);
  EXPECT_EQ(car.steering_max_rad, degrees(30));
  EXPECT_EQ(car.steering_rate_rad_s, degrees(40));
  EXPECT_NEAR(car.w_max_rad_s, 3 * std::tan(degrees(30)) / 2.5, 1e-12) << "no bound beside the steering's";
  EXPECT_EQ(read.bodies[1].base.steering_max_rad, degrees(45));
  EXPECT_EQ(read.bodies[2].base.steering_max_rad, degrees(45));
  EXPECT_EQ(read.bodies[2].base.wheelbase_m, 1);
  EXPECT_EQ(read.warnings,
            std::vector<std::string>{"a.world:3: a car's bound of steering above 45 degrees is taken as 45 degrees"});
}

TEST(Stage, ARobotTellsWhereItStandsItsTypesAndItsRangersNames) {
  const ReadStage read = stage_world(
      "define eye sensor( samples 9 fov 90 )\ndefine bot position( ranger( eye() ) )\n"
      "define red bot( ranger( name \"rear\" eye() ) ranger( eye() eye( pose [1 0 0 0] ) ) )\n"
      "bot()\nred( ranger( name \"rear\" eye() ) )\n");
  ASSERT_EQ(read.origins.size(), 2u);
  EXPECT_EQ(read.origins[0].line, 4);
  EXPECT_EQ(read.origins[0].types, (std::vector<std::string>{"bot", "position"}));
  EXPECT_EQ(read.origins[0].laser_names, std::vector<std::string>{"ranger_0"});
  EXPECT_EQ(read.origins[1].file, "a.world");
  EXPECT_EQ(read.origins[1].types, (std::vector<std::string>{"red", "bot", "position"}));
  EXPECT_EQ(read.origins[1].laser_names,
            (std::vector<std::string>{"ranger_0", "rear", "ranger_2_0", "ranger_2_1", "rear_1"}));
  ASSERT_EQ(read.bodies[1].sensors<Lasers>().size(), 5u);
}

TEST(Stage, ReportsEachIgnoredKindOnce) {
  const ReadStage read = stage_world(
      "quit_time 60\nwindow( size [1 2] )\nposition( color \"red\" ctrl \"wander\" drive \"tank\"\n"
      "  fiducial() ranger( sensor( color_rgba [0 0 1 0.15] range [0.1 5] ) ) block( points 3 point[0] [0 0] point[1] "
      "[1 0] "
      "point[2] [1 1] ) )\nmodel( color \"blue\" )\n");
  EXPECT_EQ(read.bodies.size(), 1u);
  EXPECT_EQ(read.warnings,
            (std::vector<std::string>{
                "a.world:1: 'quit_time' is left out", "a.world:2: 'window' is left out",
                "a.world:3: 'color' is left out (2 times)", "a.world:3: 'ctrl' is left out",
                "a.world:4: 'color_rgba' is left out",
                "a.world:3: a 'drive' that is none of \"diff\", \"omni\" and \"car\" is taken as \"diff\"",
                "a.world:4: a robot's 'fiducial' is left out", "a.world:4: a sensor's least 'range' is taken as 0",
                "a.world:4: a robot's 'block' is taken as the box of the robot's size"}));
}

TEST(Stage, WrongTextIsNamedByLine) {
  EXPECT_TRUE(rejects_stage("\npioner()", "a.world:2: ", "there is no type 'pioner'"));
  EXPECT_TRUE(rejects_stage("modle()", "a.world:1: ", "did you mean 'model'?"));
  EXPECT_TRUE(rejects_stage("define a a()", "a.world:1: ", "there is no type 'a'"));
  EXPECT_TRUE(
      rejects_stage("define a", "a.world:1: ", "expected the type that 'a' is made from, found the file's end"));
  EXPECT_TRUE(rejects_stage("model(\nsize [1 1 1]\n", "a.world:1: ", "expected ')' for this '('"));
  EXPECT_TRUE(rejects_stage("model( size [1 1\n)", "a.world:2: ", "expected ']' or a value, found ')'"));
  EXPECT_TRUE(rejects_stage("model( name \"a\n\" )", "a.world:1: ", "closing '\"' on this line"));
  EXPECT_TRUE(rejects_stage("model( size )", "a.world:1: ", "expected a value of 'size', found ')'"));
  EXPECT_TRUE(rejects_stage("model( [1 1] )", "a.world:1: ", "expected a type, a property or ')', found '['"));
  EXPECT_TRUE(rejects_stage("include map.inc", "a.world:1: ", "expected a file's name in quotes"));
  EXPECT_TRUE(rejects_stage("\x01\x02(", "a.world:1: ", "there is no type"));
}

TEST(Stage, WrongValuesAreNamedByLine) {
  EXPECT_TRUE(rejects_stage("model(\n size [1 nan 1] )", "a.world:2: ", "expected numbers"));
  EXPECT_TRUE(rejects_stage("model( size [1 0 1] )", "a.world:1: ", "positive size"));
  EXPECT_TRUE(rejects_stage("model( pose [1 2 3 4 5] )", "a.world:1: ", "expected 2 to 4 numbers in 'pose'"));
  EXPECT_TRUE(rejects_stage("model( pose [1e9 0 0 0] )", "a.world:1: ", "within 100000"));
  EXPECT_TRUE(rejects_stage("model( bitmap \"none.png\" )", "none.png: ", "expected an image"));
  EXPECT_TRUE(
      rejects_stage("model( block( points 4 point[0] [0 0] ) )", "a.world:1: ", "expected a block of 'points'"));
  EXPECT_TRUE(rejects_stage("position( ranger( sensor( samples 1e9 ) ) )", "a.world:1: ", "'samples'"));
  EXPECT_TRUE(rejects_stage("position( ranger( sensor( range [5 1] ) ) )", "a.world:1: ", "range [least most]"));
  EXPECT_TRUE(rejects_stage("position( drive \"car\" wheelbase 0 )", "a.world:1: ", "expected 'wheelbase' to be from"));
  EXPECT_TRUE(rejects_stage("position( velocity_bounds [1 2] )", "a.world:1: ", "expected 8 numbers"));
  EXPECT_TRUE(
      rejects_stage("position( velocity_bounds [-1 -1 0 0 0 0 -9 9] )", "a.world:1: ", "positive upper bounds"));
}

TEST(Stage, AnIncludeOfItselfOrOfNothingIsRefused) {
  const Folder folder;
  const std::string file = folder.write("a.world", "\ninclude \"b.inc\"\n");
  const std::string b = folder.write("b.inc", "include \"./a.world\"\n");
  EXPECT_TRUE(complains([&] { read_world_file(file, 2); }, b + ":1: ", "includes itself"));
  folder.write("b.inc", "include \"c.inc\"\n");
  EXPECT_TRUE(complains([&] { read_world_file(file, 2); }, b + ":1: ", "there is no file"));
  folder.write("b.inc", "define box model( size [1 1 1] )\n");
  EXPECT_TRUE(complains([&] { read_world_file(folder.write("a.world", "include \"b.inc\"\nbox( size [1] )"), 2); },
                        file + ":2: ", "expected 2 to 3 numbers"));
}

TEST(Stage, TypesThatMultiplyEndSoon) {
  std::string text = "define t0 model( size [1 1 1] )\n";
  for (int i = 0; i < 30; ++i) {
    const std::string below = "t" + std::to_string(i);
    text.append("define t" + std::to_string(i + 1)).append(" model( " + below).append("() " + below).append("() )\n");
  }
  EXPECT_TRUE(rejects_stage(text + "t30()", "a.world:", "expected at most 1048576"));
  text = "define t0 model()\n";
  for (int i = 0; i < 100; ++i) {
    text += "define t" + std::to_string(i + 1) + " model( t" + std::to_string(i) + "() )\n";
  }
  EXPECT_TRUE(rejects_stage(text, "a.world:66: ", "things in things at most 64 deep"));
  EXPECT_TRUE(rejects_stage("define t0 model()\n" + std::string(70, '\n') + "model(", "a.world:72: ", "expected ')'"));
  std::string nested;
  for (int i = 0; i < 100000; ++i) nested += "model(";
  EXPECT_TRUE(rejects_stage(nested, "a.world:1: ", "at most 64 deep"));
}

class StageData : public testing::Test {
 protected:
  void SetUp() override {
    data_ = test::data_folder();
    if (!data_) GTEST_SKIP() << "no data folder: set WAITPOINT_DATA";
  }
  WorldFile read(const std::string& name) const { return read_world_file(*data_ + "/stage/" + name, 2); }
  static std::vector<StartOverlap> overlaps(const WorldFile& file) {
    WorldDescription world;
    world.obstacles = file.obstacles;
    world.bodies = file.bodies;
    return start_overlaps(world);
  }

  std::optional<std::string> data_;
};

TEST_F(StageData, SimpleWorldIsRead) {
  const WorldFile world = read("simple.world");
  ASSERT_EQ(world.bodies.size(), 2u);
  EXPECT_EQ(world.bodies[1].name, "r1");
  EXPECT_EQ(world.bodies[1].start, (Pose{-3.946, -6.947, degrees(45)}));
  ASSERT_EQ(world.bodies[0].sensors<Lasers>().size(), 17u) << "16 sonars and the laser";
  EXPECT_EQ(world.bodies[0].sensors<Lasers>()[16].beams, 180u);
  EXPECT_GT(world.obstacles.size(), 100u);
  EXPECT_TRUE(overlaps(world).empty());
}

TEST_F(StageData, CaveWorldIsRead) {
  const WorldFile world = read("benchmark/cave.world");
  ASSERT_EQ(world.bodies.size(), 100u);
  EXPECT_EQ(world.bodies[0].name, "redrob_0");
  EXPECT_EQ(world.bodies[0].start, (Pose{-5.285, 4.915, degrees(150.459)}));
  EXPECT_EQ(world.bodies[0].shape.length_m, 0.44);
  EXPECT_EQ(world.bodies[0].sensors<Lasers>().back().beams, 180u);
  EXPECT_EQ(world.bodies[0].sensors<Lasers>().back().range_max_m, 8);
  for (const StartOverlap& overlap : overlaps(world)) ADD_FAILURE() << overlap.body << " in " << overlap.other;
}

TEST_F(StageData, HospitalWorldIsRead) {
  const WorldFile world = read("benchmark/hospital.world");
  ASSERT_EQ(world.bodies.size(), 1000u);
  ASSERT_EQ(world.bodies[999].sensors<Lasers>().size(), 1u);
  EXPECT_EQ(world.bodies[999].sensors<Lasers>()[0].beams, 12u);
  EXPECT_NEAR(world.bodies[999].sensors<Lasers>()[0].height_m, 0.05, 1e-12);
  EXPECT_GT(world.obstacles.size(), 1000u);
  EXPECT_LT(world.warnings.size(), 40u);
}

}  // namespace
}  // namespace waitpoint::world
