// SPDX-License-Identifier: BSD-3-Clause
// The paper's independence of the world server: the same robots, with the same software, in a dynamic world.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/runs/program.hpp"
#include "tests/runs/shipped.hpp"
#include "tests/tools/folder.hpp"
#include "tools/papers_modules.hpp"
#include "world/bullet/bullet_world.hpp"

namespace waitpoint::runs {
namespace {

using namespace std::chrono_literals;

constexpr const char* on_bullet = "world.engine=bullet";

std::string complaint(const scenario::Scenario& scenario) {
  try {
    run::Experiment(scenario, tools::papers_modules(), {1, kernel::Order::fifo, ""});
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

class DynamicWorlds : public testing::Test {
 protected:
  void SetUp() override {
    if (world::make_bullet_world({}, 1) == nullptr) GTEST_SKIP() << "built without Bullet";
  }

  /// A robot at (0, 0) that drives ahead without sensors, and shapes.
  scenario::Scenario scenario_with(const std::string& shapes, const std::vector<std::string>& more = {on_bullet}) {
    folder_.write("s.yaml", "format: 1\nworld: {engine: fcl, shapes: [" + shapes +
                                "]}\nrobots:\n  - name: robot\n    start: [0, 0]\n"
                                "    shape: {radius_m: 0.25, height_m: 0.4}\n    base: {mass_kg: 40}\n"
                                "    modules: [{name: rflex}]\n    bridge:\n"
                                "      - {poster: rflex.command, device: base.command}\n"
                                "      - {poster: rflex.reading, device: base.reading}\n");
    return scenario::read_scenario(folder_ / "s.yaml", more);
  }

  tools::Folder folder_;
};

// All nine goals: docs/dynamics.md promises it.
TEST_F(DynamicWorlds, TheOfficesFirstGoalsAreReached) {
  const scenario::Scenario scenario =
      shipped("office.yaml", {on_bullet, "robots.0.goals=[[2.4, 4.6], [5.3, 9.4]]", "until_s=120"});
  const bridge::RunResult result = run(scenario, scenario.until);
  EXPECT_EQ(result.outcome, bridge::Outcome::finished);
  EXPECT_EQ(result.robots[0].goals_reached(), 2u);
  EXPECT_EQ(result.robots[0].collisions, 0u);
  EXPECT_LT(result.robots[0].position_error_max_m, 0.3);
}

TEST_F(DynamicWorlds, UnmappedParcelsArePushedAside) {
  const scenario::Scenario scenario = shipped("office-dynamic.yaml");
  run::Experiment experiment(scenario, tools::papers_modules(), {1, kernel::Order::fifo, ""});
  const std::vector<world::Obstacle> before = experiment.world().description().obstacles;
  experiment.run_before(Time() + 40s);
  EXPECT_EQ(experiment.goals_reached(), 1u);
  double farthest_m = 0;
  for (const world::LooseState& loose : experiment.world().loose()) {
    const Point from = before[loose.obstacle].shape.pose.position();
    farthest_m = std::max(farthest_m, length(loose.pose.position() - from));
  }
  EXPECT_GT(farthest_m, 0.3);
}

TEST_F(DynamicWorlds, RepeatInThisProcessAndInANewOne) {
  const scenario::Scenario scenario = shipped("office-dynamic.yaml");
  const std::string digest = to_string(run(scenario).digest);
  EXPECT_EQ(to_string(run(scenario).digest), digest);
  EXPECT_EQ(outcome_of(run_command("office-dynamic.yaml", "20")).digest(), digest);
  EXPECT_NE(to_string(run(scenario, first_seconds, 2).digest), digest);
}

TEST_F(DynamicWorlds, DigestCoversLooseBodies) {
  const auto digest = [this](const std::string& low_m) {
    return run(scenario_with("{name: box, centre_m: [5, 0], size_m: [1, 1], mass_kg: 4, low_m: " + low_m + "}"),
               Duration(1s))
        .environment_digest;
  };
  EXPECT_EQ(digest("0.2"), digest("0.2"));
  EXPECT_NE(digest("0.2"), digest("0.3")) << "how it falls";
}

TEST_F(DynamicWorlds, APushFromTheOutsideActsAndAKinematicWorldRefusesIt) {
  const std::string box = "{name: box, centre_m: [3, 0], size_m: [0.4, 0.4], height_m: 0.4, mass_kg: 5}";
  const auto outcome = [](run::Experiment& experiment) {
    experiment.intervene(run::parse_intervention("push box 0 60 0.5", {}));
    experiment.run_before(Time() + 3s);
    return experiment.outcomes().at(0).text;
  };
  const scenario::Scenario dynamic = scenario_with(box), kinematic = scenario_with(box, {});
  run::Experiment pushed(dynamic, tools::papers_modules(), {1, kernel::Order::fifo, ""});
  EXPECT_EQ(outcome(pushed), "push box 0 60 0.5: done");
  EXPECT_GT(pushed.world().loose()[0].pose.y, 0.5);
  EXPECT_TRUE(pushed.result().warnings.empty());
  run::Experiment refused(kinematic, tools::papers_modules(), {1, kernel::Order::fifo, ""});
  EXPECT_EQ(outcome(refused), "push box 0 60 0.5: refused, there are no forces in a kinematic world");
  EXPECT_EQ(refused.result().warnings, std::vector<std::string>{"1 shape with mass_kg treated as fixed: only engine "
                                                                "bullet moves shapes"});
}

TEST_F(DynamicWorlds, RefuseWhatTheyCannotBeginWith) {
  const std::string wall = "{name: wall, corners_m: [2, -1, 2.2, 1]}, ";
  EXPECT_NE(complaint(scenario_with(wall + "{name: box, centre_m: [2, 0], size_m: [1, 1], mass_kg: 4}"))
                .find("s.yaml:2: 'box', which is loose, starts inside 'wall'"),
            std::string::npos);
  EXPECT_EQ(complaint(scenario_with(wall + "{name: box, corners_m: [2.2, -1, 3, 1], mass_kg: 4}")), "") << "touching";
  EXPECT_NE(complaint(scenario_with(wall, {on_bullet, "world.step_ms=1000", "robots.0.base.w_max_rad_s=3.2"}))
                .find("s.yaml:4: expected a shorter step_ms for engine bullet: robot 'robot' can turn by half a turn"),
            std::string::npos);
}

TEST(DynamicWorldsInput, IsReadStrictly) {
  const auto error = [](const std::string& assignment) {
    try {
      shipped("office.yaml", {assignment});
    } catch (const BadInput& bad) {
      return std::string(bad.what());
    }
    return std::string();
  };
  EXPECT_NE(error("world.shapes.crate.mass_kg=0").find("expected mass_kg to be a number of kg"), std::string::npos);
  EXPECT_NE(error("world.shapes.crate.mass_kg=-3").find("expected mass_kg to be a number of kg"), std::string::npos);
  EXPECT_NE(error("world.shapes.crate.mass_kg=nan").find("expected mass_kg to be a number of kg"), std::string::npos);
  EXPECT_NE(error("world.shapes.crate.friction=0.3").find("expected no friction: 'crate' has no mass_kg"),
            std::string::npos);
  EXPECT_NE(error("robot_types.rackham.base.mass_kg=0").find("mass_kg"), std::string::npos);
  EXPECT_NE(error("robot_types.rackham.base.drive_force_n=-1").find("drive_force_n"), std::string::npos);
}

TEST(DynamicWorldsInput, WithoutBulletIsOneLineThatSaysWhatToInstall) {
  if (world::make_bullet_world({}, 1) != nullptr) GTEST_SKIP() << "built with Bullet";
  EXPECT_NE(complaint(shipped("office.yaml", {on_bullet})).find("`./dev add bullet`"), std::string::npos);
}

}  // namespace
}  // namespace waitpoint::runs
