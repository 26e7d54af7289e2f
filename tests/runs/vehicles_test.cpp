// SPDX-License-Identifier: BSD-3-Clause
// Every kind of vehicle under the paper's software: commands from `rflex` reach the base, and the base's motion returns
// in its odometry.
#include <gtest/gtest.h>

#include <functional>

#include "modules/genom/module.hpp"
#include "modules/posters/base.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/runs/shipped.hpp"
#include "tests/tools/folder.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

using namespace std::chrono_literals;

class Vehicles : public testing::Test {
 protected:
  scenario::Scenario scenario_of(const std::string& base, const std::string& module = "rflex") {
    folder_.write("s.yaml",
                  "format: 1\nrobots:\n  - name: robot\n    start: [0, 0]\n"
                  "    shape: {radius_m: 0.25, height_m: 0.4}\n    base: {v_max_m_s: 2, w_max_rad_s: 3, "
                  "v_acceleration_m_s2: 1000, w_acceleration_rad_s2: 1000, " +
                      base + "}\n    modules: [{name: " + module + "}]\n    bridge:\n      - {poster: " + module +
                      ".command, device: base.command}\n      - {poster: rflex.reading, device: base.reading}\n");
    return scenario::read_scenario(folder_ / "s.yaml");
  }
  tools::Folder folder_;
};

struct Told {
  std::string base, request;
  Point centre;               // of the circle on which the robot then drives
  double w_rad_s;             // true value
  double odometry_turns = 1;  // odometry's turn per true turn
  double climb_m_s = 0;
};

// A wedge with its nose 0.4 m ahead, a pentagon from above; the box about it would touch the post beside it.
TEST_F(Vehicles, ARobotWhoseHullIsAMeshStopsWhereItsNoseMeetsTheWall) {
  folder_.write("hull.obj",
                "v 0.4 0 0.1\nv 0 0.3 0\nv -0.3 0.3 0\nv -0.3 -0.3 0\nv 0 -0.3 0\nv -0.1 0 0.4\n"
                "f 1 2 6\nf 2 3 6\nf 3 4 6\nf 4 5 6\nf 5 1 6\nf 1 5 4\nf 1 4 3\nf 1 3 2\n");
  folder_.write("robot.urdf",
                "<robot name='wedge'><link name='base'><collision><geometry><mesh filename='hull.obj'/></geometry>"
                "</collision></link></robot>");
  std::vector<std::string> digests;
  for (const std::string engine : {"fcl", "slice"}) {
    folder_.write("wedge.yaml",
                  "format: 1\nworld: {engine: " + engine +
                      ", shapes: [{corners_m: [2, -1, 2.2, 1]}, {centre_m: [1.8, 0.31], radius_m: 0.1}]}\n"
                      "robots:\n  - name: robot\n    start: [0, 0]\n    urdf: robot.urdf\n    base: {v_max_m_s: 2}\n"
                      "    modules: [{name: rflex}]\n    bridge:\n"
                      "      - {poster: rflex.command, device: base.command}\n"
                      "      - {poster: rflex.reading, device: base.reading}\n");
    const scenario::Scenario scenario = scenario::read_scenario(folder_ / "wedge.yaml");
    run::Experiment experiment(scenario, tools::papers_modules(), {1, kernel::Order::fifo, ""});
    experiment.intervene(run::parse_intervention("request robot rflex GotoSpeed v_m_s=0.5 w_rad_s=0", {}), Time() + 1s);
    experiment.run_before(Time() + 6s);
    const world::BodyState& body = experiment.world().body(world::BodyId(0));
    EXPECT_NEAR(body.pose.x, 1.6 - 1e-6, 1e-8) << engine;
    EXPECT_EQ(body.collisions, 1u);
    digests.push_back(to_string(experiment.result().digest));
  }
  EXPECT_EQ(digests[0], digests[1]);
}

class VehicleKinds : public Vehicles, public testing::WithParamInterface<Told> {};

TEST_P(VehicleKinds, GoRoundTheCircleThatTheyAreToldAndReckonIt) {
  const Told& told = GetParam();
  const scenario::Scenario scenario = scenario_of(told.base);
  run::Experiment experiment(scenario, tools::papers_modules(), {1, kernel::Order::fifo, ""});
  experiment.intervene(run::parse_intervention("request robot rflex GotoSpeed " + told.request, {}), Time() + 1s);
  const double radius = length(told.centre);
  std::size_t moving = 0;
  experiment.set_observer([&](Time) {
    const world::BodyState& body = experiment.world().body(world::BodyId(0));
    EXPECT_NEAR(length(body.pose.position() - told.centre), radius, 1e-11);
    if (body.velocity == world::Velocity()) return;
    ++moving;
    EXPECT_NEAR(body.velocity.w_rad_s, told.w_rad_s, 1e-12);
    EXPECT_NEAR(body.height_m, told.climb_m_s * 0.01 * static_cast<double>(moving), 1e-11);
  });
  experiment.run_before(Time() + 6s);
  EXPECT_GT(moving, 490u) << "told after 1 s, in time for a step soon after";
  const double turn = told.w_rad_s * 0.01 * static_cast<double>(moving);
  const auto* poster =
      dynamic_cast<genom::Poster<posters::Odometry>*>(experiment.robots()[0]->names().find_poster("rflex.odometry"));
  const posters::Odometry odometry = *poster->look();
  // Its last report is up to two steps old, and counted in units.
  EXPECT_NEAR(exact::wrap_angle(odometry.position.pose.heading - told.odometry_turns * turn), 0, 0.03);
  EXPECT_NEAR(odometry.height_m, told.climb_m_s * 0.01 * static_cast<double>(moving), 0.02);
  if (told.odometry_turns == 1) {
    EXPECT_NEAR(length(odometry.position.pose.position() - told.centre), radius, 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kind, VehicleKinds,
    testing::Values(Told{"kind: differential", "v_m_s=0.5 w_rad_s=0.4", {0, 1.25}, 0.4},
                    Told{"kind: synchro", "v_m_s=0.5 w_rad_s=-0.4", {0, -1.25}, -0.4},
                    Told{"kind: omni", "v_m_s=0.3 side_m_s=0.4 w_rad_s=0.5", {-0.8, 0.6}, 0.5},
                    Told{"kind: ackermann, steering_rate_deg_s: 1e5", "v_m_s=0.5 w_rad_s=0.4", {0, 1.25}, 0.4},
                    Told{"kind: skid_steer, effective_axle_ratio: 2", "v_m_s=0.5 w_rad_s=0.4", {0, 2.5}, 0.2, 2},
                    Told{"kind: aerial, climb_acceleration_m_s2: 1000",
                         "v_m_s=0.5 w_rad_s=0.4 climb_m_s=0.3",
                         {0, 1.25},
                         0.4,
                         1,
                         0.3}),
    [](const auto& info) {
      const std::string& base = info.param.base;
      return base.substr(6, base.find(',') == std::string::npos ? std::string::npos : base.find(',') - 6);
    });

// Commands the base once, and then computes without further commands.
class Mute : public genom::Module {
 public:
  explicit Mute(genom::ModuleSetup& setup)
      : Module(setup, 90),
        task_(add_task("main", {.period_ms = 20ms})),
        command_(add_poster<posters::BaseCommand>("command", task_)) {
    task_.set_start([this] { command_.write({0.6, 0}); });
    task_.set_permanent([] {});
  }

 private:
  genom::ExecutionTask& task_;
  genom::OutputPoster<posters::BaseCommand>& command_;
};

TEST_F(Vehicles, ABasesWatchdogStopsItWhenItsModuleFallsSilent) {
  std::vector<genom::ModuleType> types = tools::papers_modules();
  types.push_back(genom::module_type<Mute>("mute"));
  for (const bool watched : {true, false}) {
    const scenario::Scenario scenario = scenario_of(watched ? "watchdog_ms: 200" : "kind: synchro", "mute");
    run::Experiment experiment(scenario, types, {1, kernel::Order::fifo, ""});
    experiment.run_before(Time() + 2s);
    const world::BodyState& body = experiment.world().body(world::BodyId(0));
    EXPECT_EQ(body.velocity.v_m_s, watched ? 0 : 0.6);
    EXPECT_NEAR(body.travelled_m, 0.6 * (watched ? 0.2 : 2), 0.6 * 0.03);
  }
}

TEST_F(Vehicles, ABasesWatchdogHearsAModuleThatGoesOnSayingTheSame) {
  const scenario::Scenario scenario = scenario_of("watchdog_ms: 50");
  run::Experiment experiment(scenario, tools::papers_modules(), {1, kernel::Order::fifo, ""});
  experiment.intervene(run::parse_intervention("request robot rflex GotoSpeed v_m_s=0.6", {}), Time() + 1s);
  experiment.run_before(Time() + 3s);
  EXPECT_EQ(experiment.world().body(world::BodyId(0)).velocity.v_m_s, 0.6);
}

TEST(AirAndGround, ShareAnOfficeAndReachAllTheirGoals) {
  const scenario::Scenario scenario = shipped("office-air.yaml");
  run::Experiment experiment(scenario, tools::papers_modules(), {usual_seed, kernel::Order::fifo, ""});
  bool above_the_table = false;
  double highest = 0;
  experiment.set_observer([&](Time) {
    const world::BodyState& flyer = experiment.world().body(world::BodyId(1));
    highest = std::max(highest, flyer.height_m);
    above_the_table |= flyer.pose.x > 26.65 && flyer.pose.x < 29.55 && flyer.pose.y > 2.85 && flyer.pose.y < 3.75;
    EXPECT_EQ(experiment.world().body(world::BodyId(0)).height_m, 0);
  });
  EXPECT_EQ(experiment.run_before(Time() + scenario.until), RunEnd::ended);
  const bridge::RunResult result = experiment.result();
  EXPECT_TRUE(result.warnings.empty());
  for (const bridge::RobotResult& robot : result.robots) {
    EXPECT_EQ(robot.collisions, 0u);
    for (const bridge::GoalResult& goal : robot.goals) EXPECT_TRUE(goal.reached()) << robot.name << ": " << goal.report;
  }
  EXPECT_TRUE(above_the_table);
  EXPECT_NEAR(highest, 1.6, 0.02);
}

}  // namespace
}  // namespace waitpoint::runs
