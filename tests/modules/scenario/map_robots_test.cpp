// SPDX-License-Identifier: BSD-3-Clause
// Robots of a scenario from its map's file.
#include "modules/scenario/map_robots.hpp"

#include <gtest/gtest.h>

#include "modules/scenario/scenario_reader.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::scenario {
namespace {

using Kind = world::BaseDescription::Kind;

const std::string floor_text = R"(define bot position( size [0.4 0.3 0.2] velocity_bounds [-0.5 0.5 0 0 0 0 -90 90]
  ranger( sensor( samples 181 fov 180 range [0 8] ) ) )
define red bot( drive "omni" velocity_bounds [-0.5 0.5 -0.5 0.5 0 0 -90 90] )
bot( name "first" pose [1 2 0 90] )
red( pose [3 2 0 0] )
red( name "the second" pose [5 2 0 0] )
)";

const std::string types_text = R"(
robot_types:
  scout:
    base: {odometry: {travel_scale: 1.01}}
    modules: [{name: rflex}]
    bridge: [{poster: rflex.command, device: base.command}, {poster: rflex.reading, device: base.reading}]
  tall:
    shape: {radius_m: 0.3, height_m: 1}
    base: {kind: synchro}
    lasers: [{name: eye}]
)";

class RobotsFromMap : public testing::Test {
 protected:
  RobotsFromMap() { folder_.write("floor.world", floor_text); }

  Scenario read(const std::string& rest, const std::string& world = "world: {map: floor.world}") {
    return read_scenario(folder_.write("s.yaml", "format: 1\n" + world + types_text + rest));
  }
  std::string complaint(const std::string& rest, const std::string& world = "world: {map: floor.world}") {
    std::string text = message_of<BadInput>([&] { read(rest, world); });
    const std::string folder = folder_.path().string() + "/";
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
      text.erase(at, folder.size());
    return text;
  }

  TemporaryFolder folder_;
};

TEST_F(RobotsFromMap, AllOfThemAreOfTheTypeAndHaveOfTheFileWhatItLeavesOut) {
  const Scenario scenario = read("robots_from_map: scout\n");
  ASSERT_EQ(scenario.robots.size(), 3u);
  const RobotScenario& first = scenario.robots[0];
  EXPECT_EQ(first.name, "first");
  EXPECT_EQ(first.body.name, "first");
  EXPECT_EQ(first.body.start.x, 1);
  EXPECT_EQ(first.body.shape.length_m, 0.4);
  EXPECT_EQ(first.body.base.kind, Kind::differential);
  EXPECT_EQ(first.body.base.v_max_m_s, 0.5);
  EXPECT_EQ(first.body.base.odometry.travel_scale, 1.01) << "keys of the type over the file's";
  ASSERT_EQ(first.body.sensors<world::Lasers>().size(), 1u);
  EXPECT_EQ(first.body.sensors<world::Lasers>()[0].beams, 181u);
  EXPECT_EQ(first.laser_names, std::vector<std::string>{"ranger_0"});
  ASSERT_EQ(first.modules.size(), 1u);
  EXPECT_EQ(first.bridge.size(), 2u);
  EXPECT_EQ(first.start_written.text(), (folder_.path() / "floor.world").string() + ":4");
  EXPECT_EQ(scenario.robots[1].name, "red_0");
  EXPECT_EQ(scenario.robots[1].body.base.kind, Kind::omni);
  EXPECT_EQ(scenario.robots[2].name, "the_second") << "as names can be";
  EXPECT_EQ(scenario.map->robots_taken, 3u);
}

TEST_F(RobotsFromMap, KeysOfTheTypeOverrideTheFile) {
  const Scenario scenario = read("robots_from_map: tall\n");
  const world::BodyDescription& body = scenario.robots.at(0).body;
  EXPECT_EQ(body.shape.kind, world::Shape::Kind::cylinder);
  EXPECT_EQ(body.base.kind, Kind::synchro);
  EXPECT_EQ(body.base.v_max_m_s, 0.5) << "of the base only what is given";
  EXPECT_EQ(scenario.robots[0].laser_names, std::vector<std::string>{"eye"});
  ASSERT_EQ(body.sensors<world::Lasers>().size(), 1u);
  EXPECT_EQ(body.sensors<world::Lasers>()[0].beams, 361u);
}

TEST_F(RobotsFromMap, TheFirstRowOfItsNameOrAnyOfItsTypesIsARobots) {
  const Scenario scenario = read(
      "robots_from_map:\n  - {model: the second, type: scout, goals: [[1, 1]], base: {v_max_m_s: 0.3}}\n"
      "  - {model: red, type: tall}\n");
  ASSERT_EQ(scenario.robots.size(), 2u);
  EXPECT_EQ(scenario.robots[0].name, "red_0");
  EXPECT_EQ(scenario.robots[0].laser_names[0], "eye");
  EXPECT_EQ(scenario.robots[1].name, "the_second");
  EXPECT_EQ(scenario.robots[1].laser_names[0], "ranger_0");
  EXPECT_EQ(scenario.robots[1].body.base.v_max_m_s, 0.3);
  ASSERT_EQ(scenario.robots[1].goals.size(), 1u);
  EXPECT_EQ(read("robots_from_map: [{model: bot, type: scout}]\n").robots.size(), 3u) << "red is made from bot";
  EXPECT_EQ(read("robots_from_map: [{model: first, type: scout}, {type: tall}]\n").robots.size(), 3u);
}

TEST_F(RobotsFromMap, StandBesideTheScenariosOwn) {
  const Scenario scenario =
      read("robots:\n  - {name: own, type: tall, start: [9, 9]}\nrobots_from_map: [{model: first, type: scout}]\n");
  ASSERT_EQ(scenario.robots.size(), 2u);
  EXPECT_EQ(scenario.robots[0].name, "own");
  EXPECT_EQ(scenario.robots[1].name, "first");
}

TEST_F(RobotsFromMap, ALaserHasAsManyBeamsAsAModuleTakes) {
  folder_.write(
      "floor.world",
      "position( ranger( sensor( samples 1081 fov 270 ) ) )\nposition( ranger( sensor( samples 1081 fov 270 ) ) )\n");
  const Scenario scenario = read("robots_from_map: scout\n");
  EXPECT_EQ(scenario.robots[0].body.sensors<world::Lasers>()[0].beams, 721u);
  EXPECT_NEAR(scenario.robots[0].body.sensors<world::Lasers>()[0].field_of_view_rad, 1.5 * exact::pi, 1e-12);
  EXPECT_EQ(scenario.warnings,
            std::vector<std::string>{(folder_.path() / "floor.world").string() +
                                     ":1: a laser of more than 721 beams is taken with 721 (2 times)"});
}

TEST_F(RobotsFromMap, MismatchesAreReportedInOneLine) {
  EXPECT_EQ(complaint("robots_from_map: scout\n", "world: {}"), "s.yaml:12: expected a world.map for robots_from_map");
  EXPECT_EQ(complaint("robots_from_map: scuot\n"), "s.yaml:12: there is no robot type 'scuot', did you mean 'scout'?");
  EXPECT_EQ(complaint("robots_from_map: []\n"), "s.yaml:12: expected robots_from_map to have a row");
  EXPECT_EQ(complaint("robots_from_map: [{model: rad, type: scout}]\n"),
            "s.yaml:12: there is no robot 'rad', and none of that type, in 'floor.world', did you mean 'red'?");
  EXPECT_EQ(complaint("robots_from_map: [{type: scout}, {model: red, type: tall}]\n"),
            "s.yaml:12: the row matches no robot: earlier rows match all robots 'red' of the map");
  EXPECT_EQ(complaint("robots_from_map: [{type: scout}, {type: tall}]\n"),
            "s.yaml:12: the row matches no robot: earlier rows match all robots of the map");
  std::string sensors;
  world::Sensors::for_each([&]<class S>() { sensors += std::string(S::key) + ", "; });
  EXPECT_EQ(
      complaint("robots_from_map: [{type: scout, start: [1, 1]}]\n"),
      "s.yaml:12: unknown key 'start' in robot 'first' of the map, expected model, type, goals, shape, urdf, base, " +
          sensors + "modules, bridge, executive, processors, programs, control, ros, launch or nodes");
  EXPECT_EQ(complaint("robots: [{name: first, type: tall, start: [9, 9]}]\nrobots_from_map: scout\n"),
            "s.yaml:12: the map has a robot 'first' too, at floor.world:4");
  EXPECT_EQ(complaint("robots: [{name: a, type: scout, start: [9, 9]}]\nrobots_from_map: scout\n"),
            "s.yaml:5: expected key 'shape' in robot 'a'");
  folder_.write("floor.world", "model()\n");
  EXPECT_EQ(complaint("robots_from_map: scout\n"), "s.yaml:12: expected robots in 'floor.world', which has none");
  folder_.write("floor.world", "modle()\n");
  EXPECT_EQ(complaint("robots_from_map: scout\n"), "floor.world:1: there is no type 'modle', did you mean 'model'?");
}

TEST_F(RobotsFromMap, WithoutThemATypeNeedsItsShapeAsEver) {
  EXPECT_EQ(complaint("robots: [{name: a, type: tall, start: [9, 9]}]\n"),
            "s.yaml:5: expected key 'shape' in robot type 'scout'");
}

}  // namespace
}  // namespace waitpoint::scenario
