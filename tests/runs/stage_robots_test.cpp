// SPDX-License-Identifier: BSD-3-Clause
// Worlds of Stage with their robots: the scenario supplies the software, the file everything else.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "modules/genom/module.hpp"
#include "modules/posters/base.hpp"
#include "modules/run/experiment.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/project.hpp"
#include "tests/tools/folder.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint {
namespace {

// Drives to the goal in its parameters.
class Driver : public genom::Module {
 public:
  explicit Driver(genom::ModuleSetup& setup)
      : Module(setup, 93),
        task_(add_task("main", {.period_ms = std::chrono::milliseconds(100), .delay_ms = {}, .cost_us = {}})),
        base_(add_poster<posters::BaseCommand>("base", task_, &command_)) {
    setup.settings.read_one("v_m_s", command_.v_m_s);
    setup.settings.read_one("w_rad_s", command_.w_rad_s);
    setup.settings.read_one("side_m_s", command_.side_m_s);
    task_.set_permanent([] {});
  }

 private:
  genom::ExecutionTask& task_;
  posters::BaseCommand command_;
  genom::OutputPoster<posters::BaseCommand>& base_;
};

const std::string wanderers = R"(
robot_types:
  wanderer:
    modules: [{name: wander}]
    bridge:
      - {poster: wander.base, device: base.command}
      - {poster: wander.laser, device: LASER.command}
      - {poster: wander.scan, device: LASER.reading}
robots_from_map: wanderer
)";

class StageRobots : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& contents) const {
    folder_.write(name, contents);
    return (folder_ / name).string();
  }
  scenario::Scenario wandering(const std::string& map, const std::string& laser) const {
    std::string rest = wanderers;
    for (std::size_t at = rest.find("LASER"); at != std::string::npos; at = rest.find("LASER"))
      rest.replace(at, 5, laser);
    return scenario::read_scenario(write("s.yaml", "format: 1\nworld: {engine: slice, map: " + map + "}\n" + rest));
  }
  static bridge::RunResult run(const scenario::Scenario& scenario, Duration until) {
    std::vector<genom::ModuleType> types = tools::shipped_modules();
    types.push_back(genom::module_type<Driver>("driver"));
    run::Experiment experiment(scenario, types, {.seed = 1, .order = kernel::Order::fifo, .replay = ""});
    for (const auto& robot : experiment.robots()) robot->keep_paths();
    experiment.run_before(Time() + until);
    return experiment.result();
  }

  tools::Folder folder_;
};

const std::string room =
    "model( size [8 0.2 1] pose [4 -0.1 0 0] )\nmodel( size [8 0.2 1] pose [4 6.1 0 0] )\n"
    "model( size [0.2 6 1] pose [-0.1 3 0 0] )\nmodel( size [0.2 6 1] pose [8.1 3 0 0] )\n"
    "model( size [0.2 4 1] pose [4 2 0 0] )\n";

// Shape, base and laser are the file's; the software is the paper's.
TEST_F(StageRobots, FindTheirWayWithThePapersModules) {
  const std::string map = write(
      "room.world", room +
                        "define rover position( size [0.5 0.4 0.4] drive \"diff\"\n"
                        "  velocity_bounds [-0.6 0.6 0 0 0 0 -80 80] acceleration_bounds [-1 1 0 0 0 0 -180 180]\n"
                        "  ranger( name \"laser\" pose [0.1 0 -0.1 0] sensor( samples 361 fov 180 range [0 20] ) ) )\n"
                        "rover( name \"one\" pose [2 1 0 90] )\nrover( name \"two\" pose [6 5 0 -90] )\n");
  constexpr char one[] = "{model: one, type: rackham, goals: [[6.5, 1]]}";
  constexpr char two[] = "{model: two, type: rackham, goals: [[2, 1.5]]}";
  const scenario::Scenario scenario = scenario::read_scenario(
      test::project_root() / "scenarios" / "office.yaml",
      {"world.shapes=[]", "world.map=" + map, "until_s=300",
       "robots=", "robot_types.rackham.shape=", "robot_types.rackham.base=", "robot_types.rackham.lasers=",
       "robots_from_map=[" + std::string(one) + ", " + two + "]"});
  const bridge::RunResult result = run(scenario, scenario.until);
  ASSERT_EQ(result.robots.size(), 2u);
  for (const bridge::RobotResult& robot : result.robots) {
    EXPECT_EQ(robot.collisions, 0u) << robot.name;
    EXPECT_EQ(robot.goals_reached(), 1u) << robot.name;
  }
  EXPECT_TRUE(result.warnings.empty());
}

TEST_F(StageRobots, WanderWithoutGoalsAndWithoutCollisions) {
  std::string map = room +
                    "define bot position( size [0.4 0.4 0.3] drive \"diff\"\n"
                    "  ranger( sensor( samples 181 fov 180 range [0 8] ) ) )\n";
  for (int i = 0; i < 6; ++i) {
    map += fmt::format("bot( pose [{} {} 0 {}] )\n", 1 + i % 2 * 5, 1 + i / 2 * 2, 50 * i);
  }
  const bridge::RunResult result = run(wandering(write("six.world", map), "ranger_0"), std::chrono::seconds(60));
  ASSERT_EQ(result.robots.size(), 6u);
  for (const bridge::RobotResult& robot : result.robots) {
    EXPECT_EQ(robot.collisions, 0u) << robot.name;
    EXPECT_GT(robot.distance_m, 5) << robot.name;
  }
}

TEST_F(StageRobots, MoveAsTheirDriveCan) {
  const std::string map =
      write("open.world",
            "define bot position( size [0.4 0.4 0.4] velocity_bounds [-0.5 0.5 -0.5 0.5 0 0 -90 90] )\n"
            "bot( name \"diff\" pose [0 0 0 0] )\nbot( name \"omni\" drive \"omni\" pose [0 5 0 0] )\n"
            "bot( name \"car\" drive \"car\" wheelbase 0.5 pose [0 10 0 0] )\n");
  const scenario::Scenario scenario = scenario::read_scenario(
      write("s.yaml",
            "format: 1\nworld: {map: " + map +
                "}\nrobot_types:\n  driven:\n"
                "    modules: [{name: drive, type: driver}]\n"
                "    bridge: [{poster: drive.base, device: base.command}]\n"
                "robots_from_map:\n  - {model: car, type: driven, modules: [{name: drive, v_m_s: 0.5, w_rad_s: 9}]}\n"
                "  - {type: driven, modules: [{name: drive, side_m_s: 0.3}]}\n"));
  const bridge::RunResult result = run(scenario, std::chrono::seconds(20));
  ASSERT_EQ(result.robots.size(), 3u);
  EXPECT_EQ(result.robots[0].distance_m, 0) << "a differential base does not go sideways";
  EXPECT_NEAR(result.robots[1].true_path.back().pose.y, 5 + 0.3 * 20, 0.2);
  EXPECT_NEAR(result.robots[1].true_path.back().pose.x, 0, 1e-9);
  double widest_m = 0;
  for (const bridge::DatedPose& at : result.robots[2].true_path) widest_m = std::max(widest_m, at.pose.y - 10);
  EXPECT_NEAR(widest_m, 2 * 0.5, 0.15) << "a circle of the least radius: the wheelbase, at 45 degrees";
}

TEST_F(StageRobots, PositionsWithoutARowAreSkippedAndReported) {
  const std::string map =
      write("two.world", "define a position()\ndefine b position()\na( pose [0 0] )\nb( pose [3 0] )\n");
  const scenario::Scenario scenario =
      scenario::read_scenario(write("s.yaml", "format: 1\nworld: {map: " + map + "}\nrobots_from_map: [{model: a}]\n"));
  const bridge::RunResult result = run(scenario, std::chrono::seconds(1));
  ASSERT_EQ(result.robots.size(), 1u);
  EXPECT_EQ(result.robots[0].name, "a_0");
  EXPECT_EQ(result.warnings,
            std::vector<std::string>{map + ": 1 robot of the file left out: robots_from_map has no row for them"});
}

TEST_F(StageRobots, OneThatStandsInAWallIsRefusedAtItsLine) {
  const std::string map = write("walled.world", room + "position( name \"stuck\" pose [4 2 0 0] )\n");
  const scenario::Scenario scenario = scenario::read_scenario(
      write("s.yaml", "format: 1\nworld: {map: " + map + "}\nrobot_types: {bare: {}}\nrobots_from_map: bare\n"));
  try {
    run(scenario, std::chrono::seconds(1));
    ADD_FAILURE() << "no BadInput";
  } catch (const BadInput& bad) {
    EXPECT_EQ(std::string(bad.what()),
              map + ":6: robot 'stuck' starts inside 'model 4' (" + map + "), expected a free place");
  }
}

class StageRobotsData : public StageRobots {
 protected:
  void SetUp() override {
    data_ = test::data_folder();
    if (!data_) GTEST_SKIP() << "no data folder: set WAITPOINT_DATA";
  }
  std::optional<std::string> data_;
};

TEST_F(StageRobotsData, AHundredRobotsWanderInTheCave) {
  const scenario::Scenario scenario = wandering(*data_ + "/stage/benchmark/cave.world", "ranger_1");
  const bridge::RunResult result = run(scenario, std::chrono::seconds(5));
  ASSERT_EQ(result.robots.size(), 100u);
  std::size_t movers = 0;
  for (const bridge::RobotResult& robot : result.robots)
    if (robot.distance_m > 0.2) ++movers;
  EXPECT_GT(movers, 10u);
  EXPECT_EQ(result.digest, run(scenario, std::chrono::seconds(5)).digest);
}

TEST_F(StageRobotsData, AThousandRobotsWanderInTheHospital) {
  const scenario::Scenario scenario = wandering(*data_ + "/stage/benchmark/hospital.world", "ranger_0");
  const bridge::RunResult result = run(scenario, std::chrono::milliseconds(500));
  EXPECT_EQ(result.robots.size(), 1000u);
}

}  // namespace
}  // namespace waitpoint
