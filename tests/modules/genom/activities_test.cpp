// SPDX-License-Identifier: BSD-3-Clause
// The states of activities: their transitions, the defaults for missing codels, and interruptions.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "tests/modules/genom/scripted_module.hpp"

namespace waitpoint::genom {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;
using Act = Running<Number, Number>;
using Steps = Codels<Number, Number>;

constexpr State all_states[] = {State::ether, State::init,  State::start,  State::exec, State::end,
                                State::fail,  State::inter, State::zombie, State::sleep};

TEST(States, FollowEachOtherAsInGenomsExecTask) {
  const std::map<State, std::set<State>> table = {
      {State::start, {State::start, State::exec, State::sleep, State::end, State::ether, State::fail, State::zombie}},
      {State::exec, {State::exec, State::sleep, State::end, State::ether, State::fail, State::zombie}},
      {State::end, {State::end, State::ether, State::fail, State::zombie}},
      {State::inter, {State::inter, State::ether, State::fail, State::zombie}},
      {State::fail, {State::zombie}},
  };
  for (const State from : all_states)
    for (const State to : all_states) {
      const bool expected = table.contains(from) && table.at(from).contains(to);
      EXPECT_EQ(allowed(from, to), expected) << name(from) << " -> " << name(to);
    }
  EXPECT_EQ(default_after(State::start), State::exec);
  EXPECT_EQ(default_after(State::exec), State::end);
  EXPECT_EQ(default_after(State::end), State::ether);
  EXPECT_EQ(default_after(State::fail), State::zombie);
  EXPECT_EQ(default_after(State::inter), State::ether);
}

// The results of each state's codel, call by call; the last one repeats. A state without an entry has no codel.
using Plan = std::map<State, std::vector<State>>;

// A robot whose module has the request "Go"; its codels record their states and return the plan's results.
struct GoRobot : TestRobot {
  explicit GoRobot(Plan plan, TaskOptions options = {.period_ms = 10ms})
      : plans(std::move(plan)), task(module.add_task("main", options)) {
    const auto codel = [this](State state) -> Steps::Codel {
      if (!plans.contains(state)) return nullptr;
      return [this, state](Act& act) {
        trace += std::string(name(state)) + "@" + std::to_string(now().ns() / 1'000'000) + " ";
        act.output.value += 1;
        if (report != ok) act.report = report;
        std::vector<State>& left = plans[state];
        const State next = left.front();
        if (left.size() > 1) left.erase(left.begin());
        return next;
      };
    };
    module.add_activity<Number, Number>("Go", task,
                                        {.start = codel(State::start),
                                         .exec = codel(State::exec),
                                         .end = codel(State::end),
                                         .fail = codel(State::fail),
                                         .inter = codel(State::inter)});
    module.add_activity<Number, Number>("Quick", task, {});
  }
  ModuleStatus status() {
    ModuleStatus status;
    static_cast<Poster<ModuleStatus>*>(names.find_poster("m.control"))->read(status);
    return status;
  }

  Plan plans;
  ExecutionTask& task;
  std::string trace;
  genom::Report report = ok;
};

TEST(Activity, WithoutCodelsPassesAllStatesAtOneWakeUp) {
  GoRobot robot(Plan{});
  robot.run([&] {
    sleep_for(1ms);
    EXPECT_FALSE(robot.begin("Quick").final);
    EXPECT_EQ(robot.next().report, ok);
    EXPECT_EQ(now(), at(10ms));
  });
}

TEST(Activity, CallsOneCodelAtEachWakeUp) {
  GoRobot robot(Plan{{State::start, {State::start, State::exec}},
                     {State::exec, {State::exec, State::exec, State::end}},
                     {State::end, {State::end, State::ether}}});
  robot.run([&] {
    sleep_for(5ms);
    robot.begin("Go");
    const Reply ended = robot.next();
    EXPECT_EQ(robot.trace, "START@10 START@20 EXEC@30 EXEC@40 EXEC@50 END@60 END@70 ");
    EXPECT_EQ(ended.output.as<Number>().value, 7);  // kept between codels
    EXPECT_EQ(now(), at(70ms));
  });
}

TEST(Activity, AperiodicTaskRunsOnWithoutDelay) {
  GoRobot robot(Plan{{State::start, {State::exec}}, {State::exec, {State::exec, State::exec, State::end}}}, {});
  robot.run([&] {
    sleep_for(7ms);
    robot.begin("Go");
    EXPECT_EQ(robot.next().report, ok);
    EXPECT_EQ(robot.trace, "START@7 EXEC@7 EXEC@7 EXEC@7 ");
  });
}

TEST(Activity, StatesAreShownInTheControlPoster) {
  GoRobot robot(Plan{{State::exec, {State::exec, State::sleep}}});
  robot.run([&] {
    const std::int32_t number = robot.begin("Go").activity;
    ASSERT_EQ(robot.status().activities.size(), 1u);
    EXPECT_EQ(robot.status().activities[0].number, number);
    EXPECT_EQ(robot.status().activities[0].state, State::start);
    sleep_for(15ms);
    EXPECT_EQ(robot.status().activities[0].state, State::exec);
    sleep_for(10ms);
    EXPECT_EQ(robot.status().activities[0].state, State::sleep);
    robot.abort(number);
    robot.next();
    EXPECT_EQ(robot.status().activities.size(), 0u);
  });
}

TEST(Activity, ASleepingOneGoesOnWithExecAtTheNextWakeUp) {
  GoRobot periodic(Plan{{State::start, {State::sleep}}, {State::exec, {State::sleep, State::sleep, State::ether}}});
  periodic.run([&] {
    periodic.begin("Go");
    periodic.next();
    EXPECT_EQ(periodic.trace, "START@10 EXEC@20 EXEC@30 EXEC@40 ");
  });
  GoRobot aperiodic(Plan{{State::start, {State::sleep}}, {State::exec, {State::sleep, State::ether}}}, {});
  aperiodic.run([&] {
    aperiodic.begin("Go");
    EXPECT_FALSE(aperiodic.client.receive(20ms));  // it sleeps until its task is signalled
    EXPECT_EQ(aperiodic.trace, "START@0 ");
    aperiodic.abort(15);  // any letter signals it
    EXPECT_FALSE(aperiodic.client.receive(20ms));
    EXPECT_EQ(aperiodic.trace, "START@0 EXEC@20 ");
    aperiodic.abort(15);
    EXPECT_EQ(aperiodic.next().report, ok);
  });
}

TEST(Activity, AForbiddenResultSuspendsItsTaskUntilItIsResumed) {
  GoRobot robot(Plan{{State::exec, {State::start}}});
  int wake_ups = 0;
  robot.task.set_permanent([&] { ++wake_ups; });
  robot.module.add_activity<Number, Number>("Elsewhere", robot.module.add_task("other", {}), {});
  robot.run([&] {
    sleep_for(5ms);
    robot.begin("Go");
    const Reply ended = robot.next();
    EXPECT_TRUE(is(ended.report, StandardReport::forbidden_activity_transition));
    EXPECT_EQ(now(), at(10ms));
    EXPECT_TRUE(robot.status().suspended);
    const int before = wake_ups;
    sleep_for(100ms);
    EXPECT_EQ(wake_ups, before);
    for (const char* request : {"Quick", "Elsewhere"}) {
      const Reply refused = robot.begin(request);
      EXPECT_TRUE(refused.final);
      EXPECT_TRUE(is(refused.report, StandardReport::exec_task_suspended));
    }
    EXPECT_EQ(robot.abort(AbortInput::resume_tasks), ok);
    EXPECT_FALSE(robot.begin("Quick").final);
    EXPECT_EQ(robot.next().report, ok);
    EXPECT_GT(wake_ups, before);
    EXPECT_FALSE(robot.status().suspended);
  });
}

TEST(Activity, OthersOfASuspendedAperiodicTaskGoOnWhenItIsResumed) {
  GoRobot robot(Plan{{State::exec, {State::init}}}, {});
  int steps = 0;
  robot.module.add_activity<Number, Number>("Walk", robot.task, {.exec = [&](Act&) {
                                              compute(1ms);
                                              return ++steps < 20 ? State::exec : State::ether;
                                            }});
  robot.run([&] {
    robot.begin("Walk");
    sleep_for(5500us);
    ASSERT_TRUE(robot.other.send("m", "Go", Number()));
    sleep_for(50ms);
    EXPECT_LT(steps, 10);
    EXPECT_EQ(robot.abort(AbortInput::resume_tasks), ok);
    EXPECT_EQ(robot.next().report, ok);
    EXPECT_EQ(steps, 20);
  });
}

TEST(Activity, AFailedOneRepliesAndStaysAsZombieThatBlocksOthersUntilAnAbort) {
  GoRobot robot(Plan{{State::exec, {State::fail}}, {State::fail, {State::zombie}}});
  robot.run([&] {
    const Reply go = robot.begin("Go");
    sleep_for(15ms);
    const Reply quick = robot.begin("Quick");
    EXPECT_FALSE(quick.final);  // the other has not failed yet
    const Reply failed = robot.next();
    EXPECT_EQ(now(), at(20ms));
    EXPECT_EQ(robot.next().send_id, quick.send_id);
    EXPECT_EQ(failed.send_id, go.send_id);
    EXPECT_TRUE(failed.final);
    EXPECT_TRUE(is(failed.report, StandardReport::activity_failed));
    EXPECT_EQ(robot.trace, "EXEC@10 FAIL@20 ");

    EXPECT_FALSE(robot.client.receive(50ms));
    ASSERT_EQ(robot.status().activities.size(), 1u);
    EXPECT_EQ(robot.status().activities[0].state, State::zombie);
    const Reply blocked = robot.begin("Quick");
    EXPECT_TRUE(blocked.final);
    EXPECT_TRUE(is(blocked.report, StandardReport::wait_abort_zombie_activity));
    EXPECT_TRUE(is(robot.abort(AbortInput::end_module), StandardReport::system_error));

    EXPECT_EQ(robot.abort(go.activity), ok);
    EXPECT_FALSE(robot.client.receive(50ms));  // its reply came before
    EXPECT_EQ(robot.status().activities.size(), 0u);
    EXPECT_TRUE(is(robot.abort(go.activity), StandardReport::activity_already_ended));
    EXPECT_FALSE(robot.begin("Quick").final);
    EXPECT_EQ(robot.next().report, ok);
  });
}

TEST(Activity, AFailureReportsItsOwnReportOrThatItFailed) {
  for (const Plan& plan : {Plan{{State::exec, {State::fail}}}, Plan{{State::exec, {State::zombie}}},
                           Plan{{State::exec, {State::fail}}, {State::fail, {State::zombie}}}}) {
    for (const std::uint16_t own : {0, 100}) {
      GoRobot robot(plan);
      if (own != 0) robot.report = robot.module.own_report(own);
      robot.run([&] {
        robot.begin("Go");
        EXPECT_EQ(code_of(robot.next().report), own != 0 ? own : 3);
      });
    }
  }
  GoRobot robot(Plan{{State::exec, {State::exec}}, {State::inter, {State::fail}}});
  robot.run([&] {
    const Reply go = robot.begin("Go");
    sleep_for(15ms);
    robot.abort(go.activity);
    EXPECT_TRUE(is(robot.next().report, StandardReport::activity_failed));
  });
}

TEST(Activity, InFailIsNotInterrupted) {
  GoRobot robot(Plan{{State::exec, {State::fail}}, {State::fail, {State::zombie}}});
  robot.run([&] {
    const Reply go = robot.begin("Go");
    sleep_for(15ms);
    EXPECT_EQ(robot.abort(go.activity), ok);
    EXPECT_TRUE(is(robot.next().report, StandardReport::activity_failed));
    EXPECT_EQ(robot.status().activities[0].state, State::zombie);
    EXPECT_EQ(robot.trace, "EXEC@10 FAIL@20 ");
  });
}

TEST(Activity, OneThatWaitsForAnIncompatibleOneStartsWhenThatHasFailed) {
  GoRobot robot(Plan{{State::exec, {State::exec}}, {State::inter, {State::inter, State::fail}}});
  robot.module.add_activity<Number, Number>("Instead", robot.task, {.exec = [](Act&) { return State::exec; }}, {"Go"});
  robot.run([&] {
    robot.begin("Go");
    sleep_for(15ms);
    ASSERT_TRUE(robot.client.send("m", "Instead", Number()));
    EXPECT_TRUE(is(robot.next().report, StandardReport::activity_failed));
    EXPECT_FALSE(robot.next().final);
    EXPECT_EQ(now(), at(40ms));
    EXPECT_EQ(robot.trace, "EXEC@10 INTER@20 INTER@30 ");
  });
}

TEST(Activity, InInterIsNotInterruptedAgain) {
  GoRobot robot(Plan{{State::exec, {State::exec}}, {State::inter, {State::inter, State::inter, State::ether}}});
  robot.run([&] {
    const Reply go = robot.begin("Go");
    for (int i = 0; i < 4; ++i) {
      sleep_for(10ms);
      robot.abort(go.activity);
    }
    EXPECT_TRUE(is(robot.next().report, StandardReport::activity_interrupted));
    EXPECT_EQ(robot.trace, "EXEC@10 INTER@20 INTER@30 INTER@40 ");
  });
}

TEST(Activity, AnInterruptedOneReportsThatWhateverItsCodelsSay) {
  GoRobot robot(Plan{{State::exec, {State::exec}}, {State::inter, {State::ether}}});
  robot.report = robot.module.own_report(100);
  robot.run([&] {
    const Reply go = robot.begin("Go");
    sleep_for(15ms);
    robot.abort(go.activity);
    const Reply ended = robot.next();
    EXPECT_TRUE(is(ended.report, StandardReport::activity_interrupted));
    EXPECT_EQ(ended.output.as<Number>().value, 2);
    EXPECT_EQ(robot.trace, "EXEC@10 INTER@20 ");
  });
}

TEST(Activity, InterruptedInStartItsExecIsNeverCalled) {
  GoRobot robot(Plan{{State::start, {State::start, State::start, State::exec}}, {State::exec, {State::ether}}});
  robot.run([&] {
    const Reply go = robot.begin("Go");
    sleep_for(15ms);
    robot.abort(go.activity);
    EXPECT_TRUE(is(robot.next().report, StandardReport::activity_interrupted));
    EXPECT_EQ(robot.trace, "START@10 ");
  });
}

TEST(Activity, ASleepingOneOfAnAperiodicTaskIsInterruptedAtOnce) {
  GoRobot robot(Plan{{State::exec, {State::sleep}}, {State::inter, {State::ether}}}, {});
  robot.run([&] {
    const Reply go = robot.begin("Go");
    sleep_for(15ms);
    robot.abort(go.activity);
    EXPECT_TRUE(is(robot.next().report, StandardReport::activity_interrupted));
    EXPECT_EQ(robot.trace, "EXEC@0 INTER@15 ");
  });
}

// GenoM's code interrupts END, its guide says that it does not: an option selects either.
TEST(Activity, InEndIsInterruptedOrNotAsTheModuleSays) {
  for (const bool interrupt : {true, false}) {
    GoRobot robot(Plan{{State::exec, {State::end}},
                       {State::end, {State::end, State::end, State::ether}},
                       {State::inter, {State::ether}}});
    if (!interrupt) robot.module.set_interrupt_end(false);
    robot.run([&] {
      const Reply go = robot.begin("Go");
      sleep_for(25ms);
      EXPECT_EQ(robot.abort(go.activity), ok);
      const Reply ended = robot.next();
      EXPECT_EQ(is(ended.report, StandardReport::activity_interrupted), interrupt);
      EXPECT_EQ(robot.trace, interrupt ? "EXEC@10 END@20 INTER@30 " : "EXEC@10 END@20 END@30 END@40 ");
    });
  }
}

TEST(Activity, ReportsWhatItsCodelsSay) {
  GoRobot robot(Plan{{State::exec, {State::ether}}});
  robot.run([&] {
    robot.report = robot.module.own_report(105);
    robot.begin("Go");
    EXPECT_EQ(robot.next().report, make_report(ScriptedModule::number, 105));
  });
}

TEST(Activity, OneForbiddenAfterAnInterruptStillSuspends) {
  GoRobot robot(Plan{{State::exec, {State::exec}}, {State::inter, {State::exec}}});
  robot.run([&] {
    const Reply go = robot.begin("Go");
    sleep_for(15ms);
    robot.abort(go.activity);
    EXPECT_TRUE(is(robot.next().report, StandardReport::activity_interrupted));
    EXPECT_TRUE(robot.status().suspended);
  });
}

}  // namespace
}  // namespace waitpoint::genom
