// SPDX-License-Identifier: BSD-3-Clause
#include "modules/plan/plan_reader.hpp"

#include <gtest/gtest.h>

#include "modules/plan/execution.hpp"
#include "modules/plan/plan_network.hpp"
#include "tests/modules/plan/plan_text.hpp"

namespace waitpoint::plan {
namespace {

using namespace std::chrono_literals;

std::string refusal(const std::string& actions) {
  try {
    check(test::plan_of(actions));
    return "";
  } catch (const BadInput& error) {
    return error.what();
  }
}

TEST(PlanReader, SecondsAreExactToTheTick) {
  Duration duration;
  ASSERT_TRUE(parse_seconds("0.000000001", duration));
  EXPECT_EQ(duration, Duration(1ns));
  ASSERT_TRUE(parse_seconds("-12.5", duration));
  EXPECT_EQ(duration, -Duration(12500ms));
  ASSERT_TRUE(parse_seconds("1000000", duration));
  for (const char* bad : {"", "-", "1.", ".5", "1e3", "0.0000000001", "1000000.1", "+1", "1 ", "12a"})
    EXPECT_FALSE(parse_seconds(bad, duration)) << bad;
}

TEST(PlanReader, ReadsActionsWithTheirBounds) {
  const TemporalPlan plan = test::plan_of(R"(
actions:
  - {name: drive, kind: contingent, duration_s: [1, 2.5], request: ndd.GoTo, input: {via: [{x: 1, y: 2}]}}
  - name: look
    duration_s: 3
    after: drive
    when: [{poster: pom.position, field: position.pose.x, at_least: 1}]
constraints: [{from: start, to: look.end, most_s: 20}]
)");
  ASSERT_EQ(plan.actions.size(), 2u);
  EXPECT_TRUE(plan.actions[0].contingent);
  EXPECT_EQ(plan.actions[0].most, Duration(2500ms));
  EXPECT_EQ(plan.actions[0].request->input.at(1).key, "via.0.y");
  EXPECT_EQ(plan.actions[1].least, Duration(3s));
  ASSERT_EQ(plan.constraints.size(), 2u);
  EXPECT_EQ(plan.constraints[0].to, start_of(1));
  EXPECT_EQ(plan.constraints[1].name, "start to look.end");
}

TEST(PlanReader, BadInputIsALineWithItsPlace) {
  EXPECT_EQ(refusal("actions: []"), "plan.yaml:3: expected 1 to 200 actions, found 0");
  EXPECT_EQ(refusal("actions:\n  - {name: a}\n  - {name: a}"), "plan.yaml:5: there are two actions called 'a'");
  EXPECT_EQ(refusal("actions:\n  - {name: look, after: drve}\n  - {name: drive}"),
            "plan.yaml:4: there is no action 'drve', did you mean 'drive'?");
  EXPECT_EQ(refusal("actions: [{name: a, duration_s: [3, 1]}]"),
            "plan.yaml:3: expected the least duration before the greatest");
  EXPECT_EQ(
      refusal("actions: [{name: a, kind: contingent, duration_s: 1}]"),
      "plan.yaml:3: expected a request, a procedure or a rendezvous in action 'a': a contingent action ends with its "
      "report");
  EXPECT_EQ(refusal("actions: [{name: a, request: m.Go, tcl: go}]"),
            "plan.yaml:3: expected a request, a procedure or a rendezvous in action 'a', found several");
  EXPECT_EQ(refusal("actions: [{name: a, uses: {arm: 1}}]"), "plan.yaml:3: there is no resource 'arm'");
  EXPECT_EQ(refusal("actions: [{name: a}]\nconstraints: [{from: start, to: a.middle, most_s: 1}]"),
            "plan.yaml:4: expected to to be start, ACTION.start or ACTION.end, found 'a.middle'");
}

TEST(PlanReader, InconsistentPlanIsBadInputWithItsCycle) {
  EXPECT_EQ(refusal("actions:\n  - {name: drive, duration_s: [5, 9]}\n  - {name: look, after: drive}\n"
                    "constraints:\n  - {name: the light, from: start, to: look.start, most_s: 4.999999999}"),
            "plan.yaml:7: expected a consistent plan, found a cycle of constraints that contradict each other: "
            "'the light' (line 7), 'look after drive' (line 5), 'duration of drive' (line 4)");
  EXPECT_EQ(refusal("actions:\n  - {name: drive, duration_s: [5, 9]}\n  - {name: look, after: drive}\n"
                    "constraints:\n  - {name: the light, from: start, to: look.start, most_s: 5}"),
            "");
}

TEST(PlanReader, ActionsAreOrderedAtAResource) {
  const std::string two =
      "resources: [{name: base}]\nactions:\n  - {name: a, duration_s: 5, uses: {base: 1}}\n"
      "  - {name: b, duration_s: 5, uses: {base: 1}}\nconstraints:\n";
  EXPECT_EQ(refusal(two + "  - {from: start, to: a.end, most_s: 10}\n  - {from: start, to: b.end, most_s: 5}"), "");
  EXPECT_NE(refusal(two + "  - {from: start, to: a.end, most_s: 9}\n  - {from: start, to: b.end, most_s: 9}")
                .find("'resource base' (line 3)"),
            std::string::npos);
}

// Sixty have 1770 pairs, of which none has to be taken back.
TEST(PlanReader, ManyActionsAreOrderedAtAResource) {
  std::string plan = "resources: [{name: base}]\nactions:\n";
  for (int i = 0; i < 60; ++i) plan += "  - {name: a" + std::to_string(i) + ", duration_s: [1, 5], uses: {base: 1}}\n";
  EXPECT_EQ(refusal(plan), "");
}

// Eight actions of a second each in seven seconds: a search through all orders would be needed.
TEST(PlanReader, TellsThatTheSearchForAnOrderWasGivenUp) {
  std::string plan = "resources: [{name: base}]\nactions:\n", constraints = "constraints:\n";
  for (int i = 0; i < 8; ++i) {
    const std::string name = "a" + std::to_string(i);
    plan += "  - {name: " + name + ", duration_s: 1, uses: {base: 1}}\n";
    constraints += "  - {from: start, to: " + name + ".end, most_s: 7}\n";
  }
  EXPECT_EQ(refusal(plan + constraints),
            "plan.yaml:3: no order of the actions at resource 'base' was found in 1000 tries, expected parts of it as "
            "'after'");
}

TEST(PlanReader, ConsistentPlanMayNotBeControllable) {
  const PlanCheck checked = check(test::plan_of(R"(
actions:
  - {name: drive, kind: contingent, duration_s: [1, 3], request: ndd.GoTo}
  - {name: look, duration_s: 1}
constraints: [{name: just before, from: look.start, to: drive.end, least_s: 0.5, most_s: 1}]
)"));
  EXPECT_FALSE(checked.controllable);
  EXPECT_NE(checked.conflict.find("'just before' (line 6)"), std::string::npos) << checked.conflict;
  EXPECT_NE(checked.conflict.find("'duration of drive' (line 4)"), std::string::npos) << checked.conflict;
}

TEST(PlanReader, PutsProceduresOfTheScriptInAnOrder) {
  TemporalPlan plan = test::plan_of(R"(
actions:
  - {name: a, kind: contingent, duration_s: [1, 2], tcl: visit 20 6.4}
  - {name: b, duration_s: 3, request: m.Go}
  - {name: c, duration_s: 3, tcl: halt}
)");
  EXPECT_EQ(plan.actions[0].request->name, "visit");
  EXPECT_EQ(plan.actions[0].request->input.at(0).text, "20 6.4");
  EXPECT_TRUE(plan.actions[2].request->input.empty());
  Execution execution(plan);
  std::string started;
  for (PlanOrder order = execution.next({}); order.kind == PlanOrder::Kind::start; order = execution.next({})) {
    execution.started(order.action, {});
    started += plan.actions[order.action].name;
  }
  EXPECT_EQ(started, "ab") << "c waits for the end of a";
}

}  // namespace
}  // namespace waitpoint::plan
