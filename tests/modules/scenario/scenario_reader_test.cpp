// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/scenario_reader.hpp"

#include <gtest/gtest.h>

#include "tests/modules/scenario/bad_case.hpp"

namespace waitpoint::scenario {
namespace {

using namespace std::chrono_literals;

class ScenarioReader : public ::testing::Test {
 protected:
  Scenario read(std::string_view text, const std::vector<std::string>& assignments = {}) const {
    return read_scenario(folder_.write("s.yaml", text), assignments);
  }
  TemporaryFolder folder_;
};

TEST_F(ScenarioReader, ReadsEveryValue) {
  const Scenario scenario = read(valid_scenario);
  EXPECT_EQ(scenario.name, "small");
  EXPECT_TRUE(scenario.expect.all_goals_reached);
  EXPECT_EQ(scenario.expect.collisions, 0u);
  EXPECT_EQ(scenario.until, Duration(30s));
  EXPECT_EQ(scenario.step, Duration(5ms));
  ASSERT_EQ(scenario.shapes.size(), 3u);
  EXPECT_EQ(scenario.shapes[0].shape.pose, (Pose{2, 0.1, 0}));
  EXPECT_EQ(scenario.shapes[0].shape.length_m, 4);
  EXPECT_EQ(scenario.shapes[0].shape.z_high_m, 3);
  EXPECT_EQ(scenario.shapes[1].name, "shape 2");
  EXPECT_EQ(scenario.shapes[1].shape.kind, world::Shape::Kind::cylinder);
  EXPECT_EQ(scenario.shapes[1].shape.z_high_m, 2) << "the default height";
  EXPECT_EQ(scenario.shapes[2].shape.pose.heading, exact::pi / 2);
  EXPECT_FALSE(scenario.shapes[2].known);
  EXPECT_TRUE(scenario.shapes[0].known);
}

TEST_F(ScenarioReader, ReadsProcessorsAndHardwareLatency) {
  std::string text = changed("device: base.command}", "device: base.command, latency_us: 1500}");
  const std::string last = "    executive: {patience_s: 3}\n";
  text.replace(text.find(last), last.size(), last + "    processors: [cpu, io]\n");
  const RobotScenario robot = read(text).robots.at(0);
  EXPECT_EQ(robot.processors, (std::vector<std::string>{"cpu", "io"}));
  EXPECT_EQ(robot.bridge.at(0).latency, Duration(1500us));
  EXPECT_EQ(robot.bridge.at(1).latency, Duration());
}

TEST_F(ScenarioReader, FingerprintCoversContentsNotPaths) {
  const std::uint64_t whole = read(valid_scenario).fingerprint;
  EXPECT_EQ(read("# a comment\n\n" + std::string(valid_scenario)).fingerprint, whole);
  EXPECT_EQ(read(changed("step_ms: 5", "step_ms: 7"), {"world.step_ms=5"}).fingerprint, whole);
  EXPECT_NE(read(changed("step_ms: 5", "step_ms: 7")).fingerprint, whole);
  EXPECT_NE(read(changed("name: shelf", "name: shelv")).fingerprint, whole);
  EXPECT_NE(read(changed("cost_us: 300", "cost_us: 301")).fingerprint, whole);
}

TEST_F(ScenarioReader, RobotKeysOverrideTheType) {
  const Scenario scenario = read(valid_scenario);
  ASSERT_EQ(scenario.robots.size(), 2u);
  const RobotScenario &one = scenario.robots[0], &two = scenario.robots[1];
  EXPECT_EQ(one.name, "one");
  EXPECT_EQ(one.body.name, "one");
  EXPECT_EQ(one.body.start, (Pose{1, 1, exact::pi / 2}));
  EXPECT_EQ(one.body.shape.radius_m, 0.26);
  EXPECT_EQ(one.body.base.kind, world::BaseDescription::Kind::differential);
  EXPECT_EQ(one.body.base.v_max_m_s, 0.7);
  EXPECT_EQ(one.body.base.odometry.travel_scale, 1.01);
  EXPECT_EQ(one.laser_names, std::vector<std::string>{"laser"});
  EXPECT_EQ(one.body.sensors<world::Lasers>().at(0).beams, 181u);
  EXPECT_EQ(one.body.sensors<world::Lasers>().at(0).mount.x, 0.1);
  EXPECT_EQ(one.body.sensors<world::Sonars>().at(0).count, 24u);
  ASSERT_EQ(one.goals.size(), 2u);
  EXPECT_EQ(one.goals[0].position, (Point{3, 1}));
  EXPECT_EQ(one.goals[1].name, "shelf");

  EXPECT_EQ(two.body.base.v_max_m_s, 0.5);
  EXPECT_EQ(two.body.base.odometry.travel_scale, 1.01) << "what is not overridden stays";
  EXPECT_TRUE(two.goals.empty());
  ASSERT_EQ(two.modules.size(), 2u);
  EXPECT_TRUE(two.modules[0].enabled);
  EXPECT_FALSE(two.modules[1].enabled);
  EXPECT_EQ(two.modules[1].settings.size(), one.modules[1].settings.size());
}

TEST_F(ScenarioReader, ModuleParametersStayTextWithTheirLines) {
  const Scenario scenario = read(valid_scenario);
  const RobotScenario& one = scenario.robots[0];
  ASSERT_EQ(one.modules.size(), 2u);
  EXPECT_EQ(one.modules[0].type, "rflex") << "a type is named like the module unless it says so";
  ASSERT_EQ(one.modules[0].settings.size(), 2u);
  EXPECT_EQ(one.modules[0].settings[0].key, "tasks.motion.period_ms");
  EXPECT_EQ(one.modules[0].settings[0].text, "20");
  EXPECT_EQ(one.modules[0].settings[0].line, 24);
  EXPECT_EQ(one.modules[1].type, "sick");
  EXPECT_EQ(one.modules[1].settings[1].key, "gains.1");
  EXPECT_EQ(one.modules[1].settings[1].text, "2.5");
  ASSERT_EQ(one.bridge.size(), 2u);
  EXPECT_EQ(one.bridge[1].poster, "front.reading");
  EXPECT_EQ(one.bridge[1].device, "laser.reading");
  EXPECT_EQ(one.bridge[1].written.line, 28);
  EXPECT_EQ(one.executive.at(0).key, "patience_s");
}

TEST_F(ScenarioReader, WorldHasABodyForEachRobot) {
  const world::WorldDescription world = read(valid_scenario).world_without_map();
  EXPECT_EQ(world.step, Duration(5ms));
  EXPECT_EQ(world.obstacles.size(), 3u);
  ASSERT_EQ(world.bodies.size(), 2u);
  EXPECT_EQ(world.bodies[1].name, "two");
  EXPECT_EQ(world.bodies[1].start, (Pose{3, 2, 0}));
}

TEST_F(ScenarioReader, WorldIncludesAFloor) {
  folder_.write("floors/f.yaml",
                "format: 1\nshape_height_m: 2.5\nshapes:\n"
                "  - {name: wall, corners_m: [0, 0, 9, 1]}\n  - {name: post, centre_m: [5, 5], radius_m: 0.2}\n");
  const Scenario scenario = read(changed("  step_ms: 5", "  include: floors/f.yaml"));
  ASSERT_EQ(scenario.shapes.size(), 4u) << "its shapes come first, one of the same name is changed in its place";
  EXPECT_EQ(scenario.shapes[0].name, "wall");
  EXPECT_EQ(scenario.shapes[0].shape.length_m, 4);
  EXPECT_EQ(scenario.shapes[1].name, "post");
  EXPECT_EQ(scenario.shapes[1].shape.z_high_m, 2.5) << "the floor's own default height";
  EXPECT_EQ(scenario.shapes[2].shape.z_high_m, 2) << "which is not the scenario's";
  EXPECT_EQ(scenario.shapes_written[1].text(), (folder_.path() / "floors/f.yaml").string() + ":5");
}

TEST_F(ScenarioReader, ErrorsInAnIncludedFloorNameItsLine) {
  folder_.write("f.yaml", "format: 1\nshapes:\n  - {corners_m: [0, 0, 9]}\n");
  const std::string message = message_of<BadInput>([&] { read(changed("  step_ms: 5", "  include: f.yaml")); });
  EXPECT_EQ(message,
            (folder_.path() / "f.yaml").string() + ":3: expected corners_m to be a list of 4 numbers, found a list");
}

TEST_F(ScenarioReader, ScenarioTypesOverrideIncludedRobotTypes) {
  folder_.write("types.yaml", "format: 1\nrobot_types:\n  tank:\n    shape: {size_m: [1, 0.6], height_m: 0.5}\n");
  const std::string with_include = changed("  scout:", "  include: types.yaml\n  scout:");
  const Scenario scenario = read(with_include, {"robots.one.type=tank", "robot_types.tank.base.v_max_m_s=0.2"});
  EXPECT_EQ(scenario.robots[0].body.shape.length_m, 1);
  EXPECT_EQ(scenario.robots[0].body.base.v_max_m_s, 0.2);
  EXPECT_EQ(scenario.robots[1].body.shape.radius_m, 0.26);
}

TEST_F(ScenarioReader, PathsAreRelativeToTheirFile) {
  const Scenario scenario = read(changed("  step_ms: 5", "  map: {file: maps/m.yaml, height_m: 1.5}"));
  ASSERT_TRUE(scenario.map.has_value());
  EXPECT_EQ(scenario.map->file, folder_.path() / "maps/m.yaml");
  EXPECT_EQ(scenario.map->height_m, 1.5);
  EXPECT_EQ(scenario.map->written.line, 6);
  const Scenario in_short = read(changed("  step_ms: 5", "  map: maps/m.world"));
  EXPECT_EQ(in_short.map->file, folder_.path() / "maps/m.world");
  EXPECT_FALSE(in_short.map->height_m.has_value());
  EXPECT_EQ(in_short.map->written.line, 6);
}

TEST_F(ScenarioReader, MapsCanBeUnknownToRobots) {
  EXPECT_TRUE(read(changed("  step_ms: 5", "  map: {file: maps/m.yaml}")).map->known);
  EXPECT_FALSE(read(changed("  step_ms: 5", "  map: {file: maps/m.yaml, known: false}")).map->known);
}

TEST_F(ScenarioReader, MediumHasValuesAndDefaults) {
  EXPECT_FALSE(read(valid_scenario).medium.has_value());
  const auto with = [&](std::string_view medium) {
    return *read(changed("until_s: 30", "medium: {" + std::string(medium) + "}")).medium;
  };
  const io::Medium plain = with("latency_ms: 2.5");
  EXPECT_EQ(plain.latency_least, Duration(2500us));
  EXPECT_EQ(plain.latency_most, Duration(2500us));
  EXPECT_EQ(plain.bandwidth_bit_s, 0u);
  EXPECT_EQ(plain.loss, 0);
  const io::Medium full = with(
      "latency_ms: [1, 5], latency_us_per_m: 0.5, bandwidth_bit_s: 250000, queue_bytes: 0, range_m: 30, "
      "range_check_ms: 50, loss: 0.25");
  EXPECT_EQ(full.latency_least, Duration(1ms));
  EXPECT_EQ(full.latency_most, Duration(5ms));
  EXPECT_EQ(full.latency_per_metre, Duration(500ns));
  EXPECT_EQ(full.bandwidth_bit_s, 250000u);
  EXPECT_EQ(full.queue_bytes, 0u);
  EXPECT_EQ(full.range_m, 30);
  EXPECT_EQ(full.range_check, Duration(50ms));
  EXPECT_EQ(full.loss, 0.25);
}

// --- options -----------------------------------------------------------------------------------------------------

TEST_F(ScenarioReader, SetReplacesValuesByKeyIndexAndName) {
  const Scenario scenario = read(valid_scenario, {"world.step_ms=2", "robots.0.goals=[[1,2],[3,4],[5,6]]",
                                                  "robot_types.scout.modules.front.enabled=false",
                                                  "robots.two.name=three", "world.shapes.desk.known=true"});
  EXPECT_EQ(scenario.step, Duration(2ms));
  EXPECT_EQ(scenario.robots[0].goals.size(), 3u);
  EXPECT_EQ(scenario.robots[0].goals[2].position, (Point{5, 6}));
  EXPECT_FALSE(scenario.robots[0].modules[1].enabled);
  EXPECT_EQ(scenario.robots[1].name, "three");
  EXPECT_TRUE(scenario.shapes[2].known);
}

TEST_F(ScenarioReader, SetAddsMissingKeys) {
  const Scenario scenario =
      read(valid_scenario, {"world.map.file=m.yaml", "robots.two.executive.patience_s=9", "world.shapes=[]"});
  EXPECT_EQ(scenario.map->file, "m.yaml") << "relative to the current directory";
  EXPECT_TRUE(scenario.shapes.empty());
  EXPECT_EQ(scenario.robots[1].executive.at(0).text, "9");
  EXPECT_EQ(scenario.robots[1].executive.at(0).file, "--set robots.two.executive.patience_s=9");
  EXPECT_EQ(scenario.robots[0].executive.at(0).text, "3");
}

TEST_F(ScenarioReader, SetClearsOrReplacesAnIncludedFloor) {
  folder_.write("f.yaml", "format: 1\nshapes:\n  - {corners_m: [0, 0, 9, 1]}\n");
  folder_.write("g.yaml", "format: 1\nshapes: []\n");
  const std::string text = changed("  step_ms: 5", "  include: f.yaml");
  EXPECT_EQ(read(text).shapes.size(), 4u);
  EXPECT_EQ(read(text, {"world.shapes=[]"}).shapes.size(), 0u);
  EXPECT_EQ(read(text, {"world.include=" + (folder_.path() / "g.yaml").string()}).shapes.size(), 3u);
  EXPECT_EQ(read(text, {"world.include="}).shapes.size(), 3u) << "no value is the same as no key";
}

struct BadSet {
  std::string option, expected;
};

class BadAssignment : public ::testing::TestWithParam<BadSet> {};

TEST_P(BadAssignment, IsReportedInOneLineWithTheOption) {
  const TemporaryFolder folder;
  const auto file = folder.write("s.yaml", valid_scenario);
  const std::string message = message_of<BadInput>([&] { read_scenario(file, {GetParam().option}); });
  EXPECT_EQ(message, "--set " + GetParam().option + ": " + GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Scenario, BadAssignment,
    ::testing::Values(BadSet{"world.step_ms", "expected key=value"}, BadSet{"=5", "expected key=value"},
                      BadSet{"world..step_ms=5", "expected keys joined by single dots before '='"},
                      BadSet{"worl.step_ms=5", "unknown key 'worl' in the scenario, did you mean 'world'?"},
                      BadSet{"world.steps_ms=5", "unknown key 'steps_ms' in the world, did you mean 'step_ms'?"},
                      BadSet{"world.step_ms=-5", "expected step_ms to be a positive number, found '-5'"},
                      BadSet{"world.step_ms=[", "this is not valid YAML: end of sequence flow not found"},
                      BadSet{"robots.2.name=x", "there is no element 2: the list has 2, counted from 0"},
                      BadSet{"robots.oen.name=x", "the list has no element called 'oen', did you mean 'one'?"},
                      BadSet{"world.step_ms.x=5", "expected a map or list with 'x', found '5'"}),
    [](const auto& info) { return "option_" + std::to_string(info.index); });

// --- bad input ---------------------------------------------------------------------------------------------------

class BadScenario : public ::testing::TestWithParam<BadCase> {};

TEST_P(BadScenario, IsReportedInOneLineWithFileAndLine) { expect_complaint(GetParam()); }

const BadCase bad_cases[] = {
    {"a_processor_twice", "    executive: {patience_s: 3}", "    processors: [cpu, io, cpu]", 29,
     "there are two processors called 'cpu'"},
    {"a_negative_latency", "device: base.command}", "device: base.command, latency_us: -1}", 27,
     "expected latency_us to be a number from 0 to 3600000000, found '-1'"},
    {"yaml_that_does_not_parse", "until_s: 30", "until_s: [30", 5,
     "this is not valid YAML: end of sequence flow not found"},
    {"no_format", "format: 1\n", "\n", 2, "expected key 'format: 1'"},
    {"another_format", "format: 1", "format: 2", 1, "expected format to be 1, found '2'"},
    {"a_key_twice", "until_s: 30", "name: x", 4, "key 'name' is given twice, first at FILE:2"},
    {"an_unknown_key", "until_s:", "untils_s:", 4, "unknown key 'untils_s' in the scenario, did you mean 'until_s'?"},
    {"a_key_like_no_other", "  step_ms: 5", "  colour: red", 6,
     "unknown key 'colour' in the world, expected step_ms, engine, include, map, shape_height_m or shapes"},
    {"an_engine_that_is_none", "step_ms: 5", "engine: fast", 6,
     "expected engine to be fcl, slice or bullet, found 'fast'"},
    {"a_negative_step", "step_ms: 5", "step_ms: -5", 6, "expected step_ms to be a positive number, found '-5'"},
    {"a_step_of_zero", "step_ms: 5", "step_ms: 0", 6, "expected step_ms to be a positive number, found '0'"},
    {"a_step_that_is_no_number", "step_ms: 5", "step_ms: fast", 6,
     "expected step_ms to be a positive number, found 'fast'"},
    {"a_number_with_a_tail", "step_ms: 5", "step_ms: 5ms", 6, "expected step_ms to be a positive number, found '5ms'"},
    {"a_number_in_quotes", "step_ms: 5", "step_ms: '5'", 6, "expected step_ms to be a positive number, found '5'"},
    {"an_infinite_number", "until_s: 30", "until_s: inf", 4, "expected until_s to be a positive number, found 'inf'"},
    {"not_a_number", "until_s: 30", "until_s: nan", 4, "expected until_s to be a positive number, found 'nan'"},
    {"a_step_longer_than_a_second", "step_ms: 5", "step_ms: 1001", 6,
     "expected step_ms to be at most 1000, found '1001'"},
    {"a_map_where_a_list_belongs", "    goals:\n      - [3, 1]\n      - {x_m: 1, y_m: 4, name: shelf}",
     "    goals: {a: 1}", 34, "expected goals to be a list, found a map of keys"},
    {"goals_that_are_neither_all_nor_a_number", "goals_reached: all", "goals_reached: most", 3,
     "expected goals_reached to be 'all' or a number, found 'most'"},
    {"a_box_without_extent", "[0, 0, 4, 0.2]", "[0, 0, 4, 0]", 8, "expected corners_m to be opposite corners of a box"},
    {"a_shape_of_no_kind", ", radius_m: 0.3", "", 9,
     "expected 'shape 2' to have corners_m, or centre_m with size_m or radius_m"},
    {"a_shape_of_two_kinds", "corners_m: [0, 0, 4, 0.2]", "corners_m: [0, 0, 4, 1], radius_m: 1", 8,
     "expected 'wall' to have corners_m alone, or centre_m with size_m or radius_m"},
    {"a_negative_radius", "radius_m: 0.3", "radius_m: -0.3", 9,
     "expected radius_m to be a length from 0.0001 to 100000 m, found '-0.3'"},
    {"a_shape_upside_down", "height_m: 3", "height_m: 3, low_m: 4", 8,
     "expected height_m of 'wall' to be above its low_m"},
    {"two_shapes_of_one_name", "name: desk", "name: wall", 10,
     "there are two shapes called 'wall', the first at FILE:8"},
    {"a_truth_value_that_is_none", "known: false", "known: no", 10, "expected known to be true or false, found 'no'"},
    {"a_floor_that_is_not_there", "  step_ms: 5", "  include: f.yaml", 6,
     "there is no file 'FOLDER/f.yaml' to include"},
    {"a_map_without_a_file", "  step_ms: 5", "  map: {height_m: 2}", 6, "expected key 'file' in the map"},
    {"a_medium_without_latency", "until_s: 30", "medium: {loss: 0.1}", 4, "expected key 'latency_ms' in the medium"},
    {"a_medium_of_latency_zero", "until_s: 30", "medium: {latency_ms: 0}", 4,
     "expected latency_ms to be a positive number of at most 3600000, found '0'"},
    {"a_latency_from_zero", "until_s: 30", "medium: {latency_ms: [0, 5]}", 4,
     "expected latency_ms to be a positive number of at most 3600000, found '0'"},
    {"a_latency_upside_down", "until_s: 30", "medium: {latency_ms: [5, 1]}", 4,
     "expected latency_ms to be [least, greatest]"},
    {"a_latency_of_three", "until_s: 30", "medium: {latency_ms: [1, 2, 3]}", 4,
     "expected latency_ms to be a list of 2 numbers, found a list"},
    {"a_loss_above_one", "until_s: 30", "medium: {latency_ms: 1, loss: 1.5}", 4,
     "expected loss to be a probability from 0 to 1, found '1.5'"},
    {"a_negative_range", "until_s: 30", "medium: {latency_ms: 1, range_m: -5}", 4,
     "expected range_m to be a number of metres from 0.001 to 1e9, found '-5'"},
    {"a_bandwidth_of_zero", "until_s: 30", "medium: {latency_ms: 1, bandwidth_bit_s: 0}", 4,
     "expected bandwidth_bit_s to be a whole number from 1 to 1000000000000, found '0'"},
    {"an_unknown_key_of_the_medium", "until_s: 30", "medium: {latency_ms: 1, los: 0}", 4,
     "unknown key 'los' in the medium, did you mean 'loss'?"},
    {"a_type_without_a_shape", "    shape: {radius_m: 0.26, height_m: 1.2}\n", "", 13,
     "expected key 'shape' in robot type 'scout'"},
    {"a_kind_of_base_that_is_none", "kind: differential", "kind: car", 15,
     "expected kind to be differential, synchro, omni, ackermann, skid_steer or aerial, found 'car'"},
    {"an_unknown_error_of_odometry", "travel_scale: 1.01", "travel_scael: 1.01", 17,
     "unknown key 'travel_scael' in the odometry, did you mean 'travel_scale'?"},
    {"too_many_beams", "beams: 181", "beams: 5000", 19,
     "expected beams to be a whole number from 2 to 721, found '5000'"},
    {"beams_in_fractions", "beams: 181", "beams: 18.5", 19,
     "expected beams to be a whole number from 2 to 721, found '18.5'"},
    {"a_module_without_a_name", "name: rflex", "nam: rflex", 23, "expected key 'name' in a module"},
    {"two_modules_of_one_name", "name: front", "name: rflex", 25,
     "there are two modules called 'rflex', the first at FILE:23"},
    {"a_poster_without_its_module", "rflex.command", "command", 27,
     "expected poster to be two names joined by a dot, found 'command'"},
    {"a_poster_twice_in_the_table", "poster: front.reading", "poster: rflex.command", 28,
     "'rflex.command' is in the bridge's table twice, first at FILE:27"},
    {"a_row_without_a_device", ", device: laser.reading", "", 28, "expected key 'device' in a row of the bridge"},
    {"a_robot_without_a_start", "    start: [1, 1, 90]\n", "", 31, "expected key 'start' in robot 'one'"},
    {"a_start_of_one_number", "[1, 1, 90]", "[1]", 33, "expected start to be a list of 2 or 3 numbers, found a list"},
    {"an_unknown_type", "type: scout", "type: scuot", 32, "there is no robot type 'scuot', did you mean 'scout'?"},
    {"an_unknown_key_of_a_robot", "    goals:", "    gaols:", 34,
     "unknown key 'gaols' in robot 'one', did you mean 'goals'?"},
    {"a_name_with_a_dot", "name: one", "name: o.ne", 31,
     "expected the name of a robot to be of letters, digits, '_' and '-', found 'o.ne'"},
    {"two_robots_of_one_name", "name: two", "name: one", 37, "there are two robots called 'one', the first at FILE:31"},
    {"a_goal_that_is_no_point", "- [3, 1]", "- [3, north]", 35,
     "expected a goal to be a coordinate within 100 km, found 'north'"},
};

INSTANTIATE_TEST_SUITE_P(Scenario, BadScenario, ::testing::ValuesIn(bad_cases),
                         [](const auto& info) { return info.param.name; });

// A file that cannot be opened or parsed.
TEST(ScenarioFile, MissingIsReportedInOneLine) {
  EXPECT_EQ(message_of<BadInput>([] { read_scenario("nowhere/s.yaml"); }),
            "nowhere/s.yaml: cannot be read: No such file or directory");
}

TEST(ScenarioFile, EmptyIsReportedInOneLine) {
  const TemporaryFolder folder;
  const auto file = folder.write("s.yaml", "");
  EXPECT_EQ(message_of<BadInput>([&] { read_scenario(file); }),
            file.string() + ":1: expected keys such as 'format: 1', found nothing");
}

TEST(ScenarioFile, WithoutRobotsIsReportedInOneLine) {
  const TemporaryFolder folder;
  const auto file = folder.write("s.yaml", "format: 1\nrobots: []\n");
  EXPECT_EQ(message_of<BadInput>([&] { read_scenario(file); }), file.string() + ":2: expected at least one robot");
}

TEST(ScenarioFile, OverlongNameIsReportedInOneLine) {
  const TemporaryFolder folder;
  std::string letters;
  for (int i = 0; i < 200; ++i) letters += "\xc3\xa9";
  const auto read_named = [&](const std::string& name) {
    std::string text(valid_scenario);
    const std::size_t begin = text.find("name: ");
    return read_scenario(folder.write("s.yaml", text.replace(begin, text.find('\n', begin) - begin, "name: " + name)));
  };
  EXPECT_EQ(read_named(letters).name, letters);
  EXPECT_EQ(message_of<BadInput>([&] { read_named(letters + "e"); }),
            (folder.path() / "s.yaml").string() + ":2: expected name to have at most 200 characters, found 201");
}

}  // namespace
}  // namespace waitpoint::scenario
