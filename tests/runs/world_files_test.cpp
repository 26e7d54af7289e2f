// SPDX-License-Identifier: BSD-3-Clause
// Worlds from files in existing formats: the paper's robot drives through each of them, on a map drawn from it.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "modules/run/experiment.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/project.hpp"
#include "tests/tools/folder.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

scenario::Scenario scenario_on(const std::string& map, const std::string& start, const std::string& goals) {
  return scenario::read_scenario(
      test::project_root() / "scenarios" / "office.yaml",
      {"world.shapes=[]", "world.map=" + map, "until_s=600", "robots.0.start=" + start, "robots.0.goals=" + goals});
}

bridge::RunResult run(const scenario::Scenario& scenario) {
  run::Experiment experiment(scenario, tools::papers_modules(),
                             {.seed = 1, .order = kernel::Order::fifo, .replay = ""});
  EXPECT_EQ(experiment.run_before(Time() + scenario.until), RunEnd::ended);
  return experiment.result();
}

void expect_all_reached(const bridge::RunResult& result) {
  const bridge::RobotResult& robot = result.robots[0];
  EXPECT_EQ(robot.collisions, 0u);
  for (const bridge::GoalResult& goal : robot.goals) EXPECT_TRUE(goal.reached()) << goal.report;
}

class WorldFiles : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& contents) const {
    folder_.write(name, contents);
    return (folder_ / name).string();
  }

  tools::Folder folder_;
};

// A room of 8 m x 6 m, with a wall in its middle that leaves 2 m free at its end.
TEST_F(WorldFiles, ARobotFindsItsWayAmongSegments) {
  const std::string map = write("room.txt", "0 0 8 0\n8 0 8 6\n8 6 0 6\n0 6 0 0\n4 0 4 4 # in the middle\n");
  const bridge::RunResult result = run(scenario_on(map, "[2, 1, 90]", "[[6, 1], [2, 2]]"));
  expect_all_reached(result);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_GT(result.robots[0].distance_m, 14) << "around the wall, and back";
}

TEST_F(WorldFiles, ARobotFindsItsWayThroughAnSdfWorld) {
  std::string models;
  const auto box = [&](const std::string& pose, const std::string& size) {
    models += "<model name='m'><static>1</static><pose>" + pose +
              "</pose><link name='l'><collision name='c'><geometry>" + "<box><size>" + size +
              "</size></box></geometry></collision></link></model>\n";
  };
  box("4 0 1 0 0 0", "8 0.1 2");
  box("4 6 1 0 0 0", "8 0.1 2");
  box("0 3 1 0 0 1.5707963267948966", "6 0.1 2");
  box("8 3 1 0 0 1.5707963267948966", "6 0.1 2");
  box("4 2 1 0 0 0", "0.2 4 2");
  box("4 3 3 0 0 0", "8 6 0.2");  // the ceiling
  const std::string map =
      write("room.world", "<sdf version='1.6'><world name='w'><light name='sun'/>\n" + models + "</world></sdf>");
  const bridge::RunResult result = run(scenario_on(map, "[2, 1, 90]", "[[6, 1]]"));
  expect_all_reached(result);
  EXPECT_EQ(result.warnings, std::vector<std::string>{map + ":1: <light> is left out"});
}

TEST_F(WorldFiles, ARobotFindsItsWayThroughAWorldOfStages) {
  std::string image = "P2 8 6 255\n";
  for (int y = 5; y >= 0; --y)
    for (int x = 0; x < 8; ++x) image += x == 4 && y < 4 ? "0 " : "255 ";
  write("plan.pgm", image);
  const std::string map =
      write("plan.world",
            "model( size [8 6 1] pose [4 3 0 0] bitmap \"plan.pgm\" boundary 1 )\nposition( size [0.4 0.4 0.4] )\n");
  const bridge::RunResult result = run(scenario_on(map, "[2, 1, 90]", "[[6.5, 1]]"));
  expect_all_reached(result);
  EXPECT_EQ(result.warnings,
            std::vector<std::string>{map + ": 1 robot of the file left out: the robots are the scenario's"});
}

// The same room as a mesh in millimetres, with its floor and a ceiling.
TEST_F(WorldFiles, ARobotFindsItsWayInAMeshTheSameWithBothEngines) {
  std::string text;
  int corners = 0;
  const auto quad = [&](const std::string& a, const std::string& b, const std::string& c, const std::string& d) {
    for (const std::string& corner : {a, b, c, d}) text += "v " + corner + "\n";
    text += "f " + std::to_string(corners + 1) + " " + std::to_string(corners + 2) + " " + std::to_string(corners + 3) +
            " " + std::to_string(corners + 4) + "\n";
    corners += 4;
  };
  const auto wall = [&](const std::string& from, const std::string& to) {
    quad(from + " 0", to + " 0", to + " 2500", from + " 2500");
  };
  wall("0 0", "8000 0");
  wall("8000 0", "8000 6000");
  wall("8000 6000", "0 6000");
  wall("0 6000", "0 0");
  wall("4010 0", "4010 4000");
  for (const char* height : {" 0", " 2500"})
    quad(std::string("0 0") + height, std::string("8000 0") + height, std::string("8000 6000") + height,
         std::string("0 6000") + height);
  const std::string room = write("room.obj", text);
  std::optional<bridge::RunResult> first;
  for (const char* engine : {"fcl", "slice"}) {
    const bridge::RunResult result = run(scenario::read_scenario(
        test::project_root() / "scenarios" / "office.yaml",
        {"world.shapes=[{mesh: " + room + ", scale: 0.001}]", "until_s=600", std::string("world.engine=") + engine,
         "robots.0.start=[2, 1, 90]", "robots.0.goals=[[6, 1], [2, 2]]"}));
    expect_all_reached(result);
    EXPECT_GT(result.robots[0].distance_m, 14) << "around the wall, and back";
    if (first) {
      EXPECT_EQ(result.digest, first->digest);
    }
    first = result;
  }
}

TEST_F(WorldFiles, AHeightIsForWhatHasNone) {
  const std::string map = write("a.world", "model( size [1 1 1] )\n");
  const scenario::Scenario scenario = scenario_on("{file: " + map + ", height_m: 2}", "[2, 1, 90]", "[]");
  try {
    const run::Experiment experiment(scenario, tools::papers_modules(),
                                     {.seed = 1, .order = kernel::Order::fifo, .replay = ""});
    ADD_FAILURE() << "no BadInput";
  } catch (const BadInput& bad) {
    EXPECT_EQ(bad.what(), "--set world.map={file: " + map + ", height_m: 2}: expected no height_m: '" + map +
                              "' has heights of its own");
  }
}

class RealWorldFiles : public testing::Test {
 protected:
  void SetUp() override {
    data_ = test::data_folder();
    if (!data_) GTEST_SKIP() << "no data folder: set WAITPOINT_DATA";
  }
  std::optional<std::string> data_;
};

// From the benchmark's own start towards its goal, 10 m ahead, through a field of posts.
TEST_F(RealWorldFiles, ARobotCrossesAWorldOfTheBarnBenchmark) {
  expect_all_reached(run(scenario_on(*data_ + "/barn/world_1.world", "[-2.25, 3, 90]", "[[-2.25, 13]]")));
}

TEST_F(RealWorldFiles, ARobotCrossesStagesCave) {
  expect_all_reached(run(scenario_on(*data_ + "/stage/benchmark/cave.world", "[-7, -7, 45]", "[[-7, 6], [5, 7]]")));
}

}  // namespace
}  // namespace waitpoint::runs
