// SPDX-License-Identifier: BSD-3-Clause
// Robots that do not know where they are, and find out on their map.
#include <gtest/gtest.h>

#include "modules/posters/position.hpp"
#include "modules/run/intervention.hpp"
#include "tests/runs/shipped.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

using namespace std::chrono_literals;

/// The office robot with `locate` in the place of `segloc`.
scenario::Scenario office_with_locate(std::vector<std::string> assignments) {
  assignments.emplace_back("robot_types.rackham.modules.segloc.enabled=false");
  assignments.emplace_back("robot_types.rackham.modules.locate.enabled=true");
  return shipped("office.yaml", assignments);
}

double error_m(const run::Experiment& experiment) {
  const genom::NameSpace& names = experiment.robots()[0]->names();
  const auto* pom = dynamic_cast<const genom::Poster<posters::FusedPosition>*>(names.find_poster("pom.position"));
  return length(pom->look()->position.pose.position() - experiment.world().body(world::BodyId(0)).pose.position());
}

TEST(LostRobot, IsFoundAtAnUnknownStart) {
  const scenario::Scenario scenario = office_with_locate({"robots.0.executive.start_known=false"});
  run::Experiment experiment(scenario, tools::shipped_modules(), {usual_seed, kernel::Order::fifo, ""});
  experiment.run_before(Time() + 1s);
  EXPECT_GT(error_m(experiment), 1) << "it does not know";
  experiment.run_before(Time() + 20s);
  EXPECT_LT(error_m(experiment), 0.1);
  experiment.run_before(Time() + 70s);
  EXPECT_GE(experiment.goals_reached(), 1u);
  EXPECT_EQ(experiment.world().body(world::BodyId(0)).collisions, 0u);
}

TEST(LostRobot, IsFoundWhereItWasCarried) {
  const scenario::Scenario scenario = office_with_locate({});
  run::Experiment experiment(scenario, tools::shipped_modules(), {usual_seed, kernel::Order::fifo, ""});
  experiment.run_before(Time() + 40s);
  ASSERT_LT(error_m(experiment), 0.1);
  experiment.intervene(run::parse_intervention("move rackham 20 20 0", {"this test", 0}));
  experiment.run_before(Time() + 41s);
  EXPECT_GT(error_m(experiment), 1) << "it has not noticed";
  experiment.run_before(Time() + 60s);
  EXPECT_LT(error_m(experiment), 0.1);
  EXPECT_EQ(experiment.world().body(world::BodyId(0)).collisions, 0u);
}

}  // namespace
}  // namespace waitpoint::runs
