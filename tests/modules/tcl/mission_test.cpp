// SPDX-License-Identifier: BSD-3-Clause
// The shipped mission in Tcl, errors of a scenario's script, and the shell with its journal.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/modules/tcl/scripted_robot.hpp"
#include "tests/modules/tcl/scripted_run.hpp"

namespace waitpoint::tcl {
namespace {

/// The shipped scenario with a script of the test.
scenario::Scenario with_script(const std::string& script) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "waitpoint_script.tcl";
  std::ofstream(file) << script;
  return scenario::read_scenario(shipped("office-tcl.yaml"), {"robots.rackham.executive.tcl=" + file.string()});
}

TEST(Mission, InTclVisitsThePlacesThatTheExecutiveVisits) {
  const bridge::RunResult in_tcl = result_of(scenario::read_scenario(shipped("office-tcl.yaml"), {}));
  const bridge::RunResult in_cpp = result_of(scenario::read_scenario(shipped("office.yaml"), {}));
  ASSERT_EQ(in_tcl.robots[0].goals.size(), in_cpp.robots[0].goals.size());
  Time last;
  for (std::size_t i = 0; i < in_cpp.robots[0].goals.size(); ++i) {
    const auto &a = in_tcl.robots[0].goals[i], &b = in_cpp.robots[0].goals[i];
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.report, "reached") << i;
    EXPECT_EQ(b.report, "reached") << i;
    EXPECT_GT(a.date, last) << "in the order of the file";
    last = a.date;
  }
  EXPECT_EQ(in_tcl.robots[0].collisions, 0u);
  EXPECT_NEAR(in_tcl.robots[0].distance_m, in_cpp.robots[0].distance_m, 0.1 * in_cpp.robots[0].distance_m);
  EXPECT_EQ(in_tcl.outcome, bridge::Outcome::finished);
}

TEST(Mission, RepeatsBitForBit) {
  const scenario::Scenario scenario =
      scenario::read_scenario(shipped("office-tcl.yaml"), {"until_s=20", "expect.goals_reached=0"});
  EXPECT_EQ(result_of(scenario).digest, result_of(scenario).digest);
}

// What a script that waits in a procedure writes afterwards.
std::string written(std::uint64_t seed, const std::string& intervention) {
  const scenario::Scenario scenario =
      with_script("proc late {} { after 1000; return \"late \" }\nputs \"[late][expr {rand()}]\"\n");
  run::Experiment experiment(scenario, tools::papers_modules(), {seed, kernel::Order::fifo, ""});
  if (!intervention.empty())
    experiment.intervene(run::parse_intervention(intervention, {"test", 0}), Time::from_ns(500'000'000));
  testing::internal::CaptureStderr();
  experiment.run_before(Time::from_ns(1'500'000'000));
  return testing::internal::GetCapturedStderr();
}

TEST(Mission, DrawsAsWithAnotherSeedFromAnInstantOn) {
  const std::string changed = written(1, "seed 2");
  EXPECT_NE(changed.find("rackham: late 0."), std::string::npos) << changed;
  EXPECT_EQ(changed, written(2, ""));
  EXPECT_NE(changed, written(1, ""));
}

TEST(Mission, WithASyntaxErrorIsBadInput) {
  const scenario::Scenario scenario = with_script("connect\nproc f {} {\n");
  try {
    result_of(scenario);
    FAIL();
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("waitpoint_script.tcl:2: expected a closing brace"), std::string::npos)
        << error.what();
  }
}

TEST(Mission, FailureEndsTheRunWithItsPlace) {
  const scenario::Scenario scenario = with_script("after 2500\nlm rflex\nrflex::PosterRead nothing\n");
  try {
    result_of(scenario);
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("executive"), std::string::npos) << what;
    EXPECT_NE(what.find("2.500000000"), std::string::npos) << what;
    EXPECT_NE(what.find("waitpoint_script.tcl:3: there is no poster 'rflex.nothing'"), std::string::npos) << what;
  }
}

TEST(Shell, AnswersInTheRobotsTaskAndRepeats) {
  const scenario::Scenario scenario = scenario::read_scenario(shipped("office.yaml"), {"until_s=3"});
  const auto run_it = [&](Digest& digest) {
    run::Experiment experiment(scenario, tools::papers_modules(), {1, kernel::Order::fifo, ""});
    experiment.run_before(Time() + std::chrono::milliseconds(500));
    for (const char* command : {"tcl rackham lm rflex", "tcl rackham rflex::GotoSpeed -async v_m_s=0.1; set x 7",
                                "tcl rackham after 500\xE2\x90\xA4"
                                "expr {$x + [clock milliseconds]}"})
      experiment.intervene(run::parse_intervention(command, {"test", 1}));
    experiment.run_before(Time() + std::chrono::seconds(2));
    digest = experiment.simulation().digest();
    std::string text;
    for (const run::InterventionOutcome& outcome : experiment.outcomes())
      if (outcome.is_reply) text += outcome.text + "|";
    return text;
  };
  Digest first, second;
  EXPECT_EQ(run_it(first), "tcl rackham: rflex|tcl rackham: 7|tcl rackham: 1007|");
  run_it(second);
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace waitpoint::tcl
