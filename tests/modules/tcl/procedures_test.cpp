// SPDX-License-Identifier: BSD-3-Clause
// Procedures of a script below a temporal plan: all levels together, failures, interruptions, and bad calls.
#include "modules/tcl/procedures.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/modules/tcl/scripted_run.hpp"

namespace waitpoint::tcl {
namespace {

/// The shipped scenario, with procedures behind those of the shipped script and other actions of the plan.
class ProceduresBelowPlan : public testing::Test {
 protected:
  ProceduresBelowPlan() {
    std::ifstream script(shipped("laas.tcl"));
    script_.assign(std::istreambuf_iterator<char>(script), {});
  }

  scenario::Scenario scenario(const std::string& procedures, const std::string& actions,
                              const std::string& rules = "") const {
    const std::filesystem::path folder = testing::TempDir();
    const std::string script = folder / "procedures.tcl", plan = folder / "procedures_plan.yaml";
    std::ofstream(script) << script_ << procedures;
    std::vector<std::string> changes = {"robots.0.executive.tcl=" + script, "robots.0.plan=" + plan, "until_s=60"};
    if (!rules.empty()) {
      const std::string control = folder / "procedures.ctl";
      std::ofstream(control) << rules;
      changes.push_back("robots.0.control=" + control);
    }
    std::ofstream(plan) << "format: 1\nname: test\nready: [{poster: pom.position}, {poster: sick.echoes}]\n" << actions;
    return scenario::read_scenario(shipped("laas.yaml"), changes);
  }
  bridge::RobotResult run(const std::string& procedures, const std::string& actions,
                          const std::string& rules = "") const {
    return result_of(scenario(procedures, actions, rules)).robots.at(0);
  }
  std::string refusal(const std::string& actions) const {
    try {
      run("", actions);
      return "";
    } catch (const BadInput& error) {
      const std::string what = error.what();
      return what.substr(what.find("procedures_plan"));
    }
  }
  /// The log without dates.
  static std::string log(const bridge::RobotResult& robot) {
    std::string text;
    for (const std::string& line : robot.plan->log) text += line.substr(line.find(": ") + 2) + "|";
    return text;
  }

 private:
  std::string script_;
};

TEST_F(ProceduresBelowPlan, AreDispatchedByThePlanThroughTheControl) {
  const scenario::Scenario scenario = scenario::read_scenario(shipped("laas.yaml"), {});
  const bridge::RunResult first = result_of(scenario), second = result_of(scenario);
  EXPECT_TRUE(first.robots.at(0).plan->completed) << first.robots.at(0).plan->end;
  EXPECT_GT(first.robots.at(0).distance_m, 8);
  EXPECT_EQ(first.digest, second.digest);
}

TEST_F(ProceduresBelowPlan, EndTheirActionsAndRunOneAfterAnother) {
  const bridge::RobotResult robot = run("proc pause {ms} { after $ms }\n", R"(
actions:
  - {name: a, kind: contingent, duration_s: [1, 3], tcl: pause 2000}
  - {name: b, kind: contingent, duration_s: [1, 3], tcl: pause 1000}
)");
  ASSERT_EQ(log(robot), "start of a|end of a|start of b|end of b|completed|");
  const auto date = [&](std::size_t line) { return std::stod(robot.plan->log.at(line)); };
  constexpr double step_s = 0.001;  // of the control, at the start and the end
  EXPECT_NEAR(date(1) - date(0), 2, step_s);
  EXPECT_NEAR(date(3) - date(2), 1, step_s);
}

TEST_F(ProceduresBelowPlan, WithAnErrorFailTheirActions) {
  const bridge::RobotResult robot = run("proc fail {} { error \"no way\" }\nproc pause {ms} { after $ms }\n", R"(
actions:
  - {name: a, kind: contingent, duration_s: [0, 3], tcl: fail}
  - {name: b, kind: contingent, duration_s: [0, 3], tcl: pause 500}
alternatives: [{name: way, branches: [[a], [b]]}]
)");
  EXPECT_EQ(log(robot),
            "start of a|failed: a: report own report 100|alternative 'way', branch 2|start of b|end of b|completed|");
}

TEST_F(ProceduresBelowPlan, WithAnExitFailTheirActions) {
  const bridge::RobotResult robot = run("proc leave {} { exit }\nproc pause {ms} { after $ms }\n", R"(
actions:
  - {name: a, kind: contingent, duration_s: [0, 3], tcl: leave}
  - {name: b, kind: contingent, duration_s: [0, 3], tcl: 'pause [exit]'}
  - {name: c, kind: contingent, duration_s: [0, 3], tcl: pause 500}
alternatives: [{name: way, branches: [[a], [b], [c]]}]
)");
  EXPECT_EQ(log(robot),
            "start of a|failed: a: report own report 100|alternative 'way', branch 2|start of b|failed: b: report own "
            "report 100|alternative 'way', branch 3|start of c|end of c|completed|");
}

// The end of the action aborts the procedure, and the way that it drives.
TEST_F(ProceduresBelowPlan, AreInterruptedWithTheirRequests) {
  const bridge::RobotResult robot = run("proc pause {ms} { after $ms }\n", R"(
actions:
  - {name: go, duration_s: 2, tcl: visit 20.05 9.4}
  - {name: rest, kind: contingent, duration_s: [0, 9], tcl: pause 5000, after: go}
)");
  EXPECT_EQ(log(robot), "start of go|stop of go|start of rest|end of rest|completed|");
  EXPECT_GT(robot.distance_m, 0.2);
  EXPECT_LT(robot.distance_m, 2) << "it went on after the end of the action";
}

// The control would hold the way back for longer than the plan lasts: an interrupted procedure does not wait for it.
TEST_F(ProceduresBelowPlan, WithdrawDelayedRequestsWhenTheyAreInterrupted) {
  const bridge::RobotResult robot = run(
      "proc pause {ms} { after $ms }\n", R"(
actions:
  - {name: go, duration_s: 2, tcl: visit 20.05 9.4}
  - {name: rest, kind: contingent, duration_s: [0, 9], tcl: pause 5000, after: go}
)",
      "context c { check k { fail: running(ndd.GoTo) && running(sick.ContinuousShot); delay: ndd.GoTo for 50 s; } }");
  EXPECT_EQ(log(robot), "start of go|stop of go|start of rest|end of rest|completed|");
  EXPECT_LT(robot.distance_m, 0.01);
}

// As in catch {}: the procedure does not go on behind its interruption, and leaves the interpreter usable.
TEST_F(ProceduresBelowPlan, CannotCatchTheirInterruption) {
  const bridge::RobotResult robot = run(R"(
set went_on 0
proc stay {} { catch { after 60000 }; incr ::went_on }
proc check {} { if {$::went_on} { error "it went on" } }
)",
                                        R"(
actions:
  - {name: stay, duration_s: 1, tcl: stay}
  - {name: check, kind: contingent, duration_s: [0, 1], tcl: check, after: stay}
)");
  EXPECT_EQ(log(robot), "start of stay|stop of stay|start of check|end of check|completed|");
}

TEST_F(ProceduresBelowPlan, BadCallsAreBadInput) {
  const std::string place = "procedures_plan.yaml:4: ";
  EXPECT_EQ(refusal("actions: [{name: a, tcl: vist 1 2}]"),
            place + "the script has no procedure 'vist', did you mean 'visit'?");
  EXPECT_EQ(refusal("actions: [{name: a, tcl: Abort 1}]"), place + "the script has no procedure 'Abort'");
  EXPECT_EQ(refusal("actions: [{name: a, tcl: visit 1}]"), place + "wrong # args: should be \"visit x y\"");
  EXPECT_EQ(refusal("actions: [{name: a, tcl: 'visit {1 2'}]"), place + "expected a closing brace for this one");
  EXPECT_EQ(refusal("actions: [{name: a, tcl: halt ; halt}]"), place + "expected one command, found 'halt ; halt'");
}

TEST_F(ProceduresBelowPlan, NeedAScript) {
  const scenario::Scenario scenario = scenario::read_scenario(shipped("laas.yaml"), {"robots.0.executive=~"});
  try {
    result_of(scenario);
    FAIL();
  } catch (const BadInput& error) {
    EXPECT_NE(
        std::string(error.what()).find("expected executive: {tcl: FILE} at this robot, with the procedure 'halt'"),
        std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace waitpoint::tcl
