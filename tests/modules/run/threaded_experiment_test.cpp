// SPDX-License-Identifier: BSD-3-Clause
// The paper's first aim: the same modules, bridge and executive in simulation and on real threads, in the same world. A
// loaded machine may be late: the test requires that the robot arrives, at any time.
#include "modules/run/threaded_experiment.hpp"

#include <gtest/gtest.h>

#include "modules/ndd/ndd.hpp"
#include "modules/pom/pom.hpp"
#include "modules/rflex/rflex.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "modules/segloc/segloc.hpp"
#include "modules/sick/sick.hpp"
#include "tests/modules/on_threads.hpp"
#include "tests/project.hpp"

namespace waitpoint::run {
namespace {

using namespace std::chrono_literals;

// The shipped office, with other goals.
scenario::Scenario office(const std::string& goals) {
  return scenario::read_scenario(test::project_root() / "scenarios" / "office.yaml", {"robots.0.goals=" + goals});
}

const std::vector<genom::ModuleType> papers_modules = {
    genom::module_type<ndd::Ndd>("ndd"), genom::module_type<pom::Pom>("pom"), genom::module_type<rflex::Rflex>("rflex"),
    genom::module_type<segloc::Segloc>("segloc"), genom::module_type<sick::Sick>("sick")};

template <class T>
T last(const bridge::Robot& robot, const std::string& poster) {
  return dynamic_cast<const genom::Poster<T>&>(*robot.names().find_poster(poster)).look().value_or(T());
}

TEST(ThreadedExperiment, ReachesItsFirstGoal) {
  const scenario::Scenario scenario = office("[[22.4, 6.6]]");
  on_threads([&] {
    ThreadedExperiment experiment(scenario, papers_modules, 1);
    experiment.robots().at(0)->keep_paths();
    experiment.run_for(100s);
    const bridge::RunResult result = experiment.result();
    EXPECT_EQ(result.outcome, bridge::Outcome::finished);
    const bridge::RobotResult& robot = result.robots.at(0);
    EXPECT_EQ(robot.goals_reached(), 1u) << robot.goals.at(0).report;
    const Pose& truth = experiment.world().body(world::BodyId(0)).pose;
    EXPECT_LT(length(truth.position() - Point{22.4, 6.6}), 0.5);
    EXPECT_GT(robot.distance_m, 1.5);
    EXPECT_GT(robot.true_path.size(), 10u);
    EXPECT_GT(robot.estimated_path.size(), 10u);
    EXPECT_LT(robot.position_error_mean_m, 0.5);
    EXPECT_GT(robot.segments.size(), 3u);  // the map of segloc
  });
}

TEST(ThreadedExperiment, StopsTheRobotAndEndsItsModulesWhenTheTimeIsUp) {
  const scenario::Scenario scenario = office("[[2.4, 4.6], [35, 28.4]]");
  on_threads([&] {
    ThreadedExperiment experiment(scenario, papers_modules, 1);
    experiment.run_for(1500ms);
    EXPECT_EQ(experiment.result().outcome, bridge::Outcome::time_limit);
    EXPECT_EQ(experiment.result().robots.at(0).goals_reached(), 0u);
    const bridge::Robot& robot = *experiment.robots().at(0);
    EXPECT_EQ(last<posters::BaseCommand>(robot, "rflex.command").v_m_s, 0);
    EXPECT_FALSE(last<posters::LaserCommand>(robot, "sick.command").on);
    for (const char* module : {"rflex", "sick", "segloc", "pom", "ndd"})
      EXPECT_EQ(last<genom::ModuleStatus>(robot, std::string(module) + ".control").activities.size(), 0u) << module;
  });
}

}  // namespace
}  // namespace waitpoint::run
