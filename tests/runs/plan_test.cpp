// SPDX-License-Identifier: BSD-3-Clause
// Temporal plans, from the scenario to the summary.
#include <gtest/gtest.h>

#include <set>

#include "tests/project.hpp"
#include "tests/runs/program.hpp"
#include "tests/tools/folder.hpp"

namespace waitpoint::runs {
namespace {

Outcome waitpoint_with(const std::vector<std::string>& words) {
  Command command{{program().string()}};
  command.words.insert(command.words.end(), words.begin(), words.end());
  command.folder = test::project_root();
  return outcome_of(command);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Plan, TwoRobotsKeepTheirPlansAndMeet) {
  const Outcome first = outcome_of(run_command("office-plan.yaml", "300"));
  EXPECT_EQ(first.status, 0) << first.errors << first.output;
  EXPECT_TRUE(has(first.errors, "guide: plan 'the guide's round': ")) << first.errors;
  EXPECT_TRUE(has(first.errors, "consistent, dynamically controllable")) << first.errors;
  EXPECT_TRUE(has(first.output, "guide: plan 'the guide's round' completed")) << first.output;
  EXPECT_TRUE(has(first.output, "helper: plan 'the helper's errand' completed")) << first.output;
  // At the first tick of the door's window, 20 s after the plan's start.
  EXPECT_TRUE(has(first.output, "20.200000000 s: start of pass the door")) << first.output;
  const Outcome second = outcome_of(run_command("office-plan.yaml", "300"));
  EXPECT_EQ(first.digest(), second.digest());
}

TEST(Plan, IsKeptWithTheNoiseOfOtherSeeds) {
  std::set<std::string> digests;
  for (const char* seed : {"2", "3", "4"}) {
    const Outcome outcome = outcome_of(run_command("office-plan.yaml", "300", {"--seed", seed}));
    EXPECT_EQ(outcome.status, 0) << seed << outcome.errors << outcome.output;
    EXPECT_TRUE(has(outcome.output, "20.200000000 s: start of pass the door")) << outcome.output;
    digests.insert(outcome.digest());
  }
  EXPECT_EQ(digests.size(), 3u);
}

// The robot drives from y = 4 m on.
TEST(Plan, ConditionDuringAnActionEndsItWhenItNoLongerHolds) {
  const tools::Folder folder;
  folder.write("p.yaml", R"(
format: 1
name: p
setup:
  - {request: rflex.SetPos, input: start}
  - {request: pom.SetPos, input: start}
  - sick.ContinuousShot
  - rflex.TrackSpeedStart
ready: [{poster: pom.position}, {poster: sick.echoes}]
actions:
  - name: go
    kind: contingent
    duration_s: [1, 20]
    request: ndd.GoTo
    input: {via: [{x: 20.05, y: 6.4}]}
    during: [{poster: rflex.odometry, field: position.pose.y, at_most: 5}]
safe: [ndd.Stop, rflex.Stop, sick.Stop]
)");
  const std::string plan = "robots.rackham.plan=" + (folder / "p.yaml").string();
  const Outcome outcome = waitpoint_with(
      {"run", "scenarios/office.yaml", "--set", "robots.rackham.goals=~", "--set", plan, "--until", "20"});
  EXPECT_TRUE(has(outcome.output,
                  "plan 'p' aborted: action 'go' failed: expected that rflex.odometry.position.pose.y is at most 5"))
      << outcome.output << outcome.errors;
  EXPECT_FALSE(has(outcome.output, "end of go")) << outcome.output;
}

// The control holds the motion back until the localisation ends, and the plan with it: it does not run after that.
TEST(Plan, RequestsThatTheControlDelaysEndWithTheirActions) {
  const tools::Folder folder;
  folder.write("r.ctl", R"(
context c {
  check k { fail: running(rflex.GotoSpeed) && running(segloc.Localise); delay: rflex.GotoSpeed for 60 s; }
}
)");
  folder.write("p.yaml", R"(
format: 1
name: p
setup:
  - {request: rflex.SetPos, input: start}
  - {request: pom.SetPos, input: start}
  - sick.ContinuousShot
ready: [{poster: sick.echoes}]
actions:
  - {name: localise, duration_s: 2, request: segloc.Localise, input: start}
  - {name: move, duration_s: 1, request: rflex.GotoSpeed, input: {v_m_s: 0.2}}
constraints: [{from: localise.start, to: move.start, least_s: 0.5}]
done: [rflex.Stop]
)");
  const Outcome outcome = waitpoint_with({"run", "scenarios/office.yaml", "--set", "robots.rackham.goals=~", "--set",
                                          "robots.rackham.plan=" + (folder / "p.yaml").string(), "--set",
                                          "robots.rackham.control=" + (folder / "r.ctl").string(), "--until", "8",
                                          "--decisions", (folder / "decisions").string()});
  EXPECT_EQ(outcome.status, 0) << outcome.output << outcome.errors;
  const std::string decisions = folder.read("decisions");
  EXPECT_TRUE(has(decisions, "rflex.GotoSpeed #5 withdrawn")) << decisions;
  EXPECT_FALSE(has(decisions, "rflex.GotoSpeed #5 accepted")) << decisions;
}

TEST(Plan, InconsistentPlanIsRefusedWithItsCycle) {
  const tools::Folder folder;
  folder.write("s.yaml",
               "format: 1\nrobots: [{name: a, start: [0, 0, 0], shape: {radius_m: "
               "0.2, height_m: 1}, base: {kind: synchro}, plan: p.yaml}]\n");
  folder.write("p.yaml",
               "format: 1\nname: p\nactions: [{name: wait, duration_s: 5}]\n"
               "constraints: [{name: hurry, from: start, to: wait.end, most_s: 4}]\n");
  const Outcome outcome = waitpoint_with({"run", folder / "s.yaml"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(has(outcome.errors,
                  "p.yaml:4: expected a consistent plan, found a cycle of constraints that contradict "
                  "each other: 'hurry' (line 4), 'duration of wait' (line 3)"))
      << outcome.errors;
}

TEST(Plan, ExploreFailsAPlanThatIsConsistentButNotControllable) {
  const std::string scenario = "tests/runs/plans/unlucky_scenario.yaml";
  const Outcome run = waitpoint_with({"run", scenario});
  EXPECT_EQ(run.status, 0) << run.errors << run.output;
  EXPECT_TRUE(has(run.errors, "NOT dynamically controllable, by ")) << run.errors;
  EXPECT_TRUE(has(run.errors, "'just before' (line 9)")) << run.errors;
  const Outcome explored = waitpoint_with({"explore", scenario, "--iterations", "50", "--no-minimize"});
  EXPECT_EQ(explored.status, 1) << explored.output;
  EXPECT_TRUE(has(explored.output, "0 of 1 plans completed, expected all: robot guide: aborted: action 'halt' failed"))
      << explored.output;
}

}  // namespace
}  // namespace waitpoint::runs
