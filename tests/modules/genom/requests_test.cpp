// SPDX-License-Identifier: BSD-3-Clause
// Kinds of requests and their replies, what a control task refuses, and who interrupts whom.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/modules/genom/scripted_module.hpp"

namespace waitpoint::genom {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;
using Act = Running<Number, Number>;

// Goes on until it is interrupted.
State for_ever(Act&) { return State::exec; }

struct RobotWithTask : TestRobot {
  ExecutionTask& task = module.add_task("main", {.period_ms = 10ms});
};

TEST(ControlRequest, HasOneFinalReplyWithItsOutput) {
  TestRobot robot;
  robot.module.add_control<Number, Number>("Double", [](const Number& in, Number& out) {
    out.value = 2 * in.value;
    return ok;
  });
  robot.run([&] {
    const Reply reply = robot.begin("Double", 21);
    EXPECT_TRUE(reply.final);
    EXPECT_EQ(reply.report, ok);
    EXPECT_EQ(reply.activity, -1);
    EXPECT_EQ(reply.output.as<Number>().value, 42);
    EXPECT_EQ(now(), Time());
    EXPECT_FALSE(robot.client.receive(1s));
  });
}

TEST(ControlRequest, CostsItsTimeBeforeTheReply) {
  TestRobot robot;
  robot.module.add_control<Number>("Set", [](const Number&, Nothing&) { return ok; }).cost = 300us;
  robot.run([&] {
    sleep_for(1ms);
    robot.begin("Set");
    EXPECT_EQ(now(), at(1300us));
  });
}

TEST(ControlRequest, ReportsWhatItsCodelSays) {
  TestRobot robot;
  robot.module.add_control<Number>("Refuse", [&](const Number&, Nothing&) { return robot.module.own_report(101); });
  robot.run([&] {
    const Reply reply = robot.begin("Refuse");
    EXPECT_EQ(module_of(reply.report), ScriptedModule::number);
    EXPECT_EQ(code_of(reply.report), 101);
    EXPECT_STREQ(name(reply.report), "own report");
  });
}

TEST(ExecutionRequest, HasAnIntermediateReplyWithItsActivityAndAFinalOne) {
  RobotWithTask robot;
  robot.module.add_activity<Number, Number>("Count", robot.task, {.exec = [](Act& a) {
                                              a.output.value += a.input.value;
                                              return a.output.value < 15 ? State::exec : State::ether;
                                            }});
  robot.run([&] {
    sleep_for(1ms);
    const Reply begun = robot.begin("Count", 5);
    EXPECT_FALSE(begun.final);
    EXPECT_EQ(begun.report, ok);
    EXPECT_GE(begun.activity, 0);
    EXPECT_EQ(now(), at(1ms));
    const Reply ended = robot.next();
    EXPECT_TRUE(ended.final);
    EXPECT_EQ(ended.send_id, begun.send_id);
    EXPECT_EQ(ended.activity, begun.activity);
    EXPECT_EQ(ended.report, ok);
    EXPECT_EQ(ended.output.as<Number>().value, 15);
    EXPECT_EQ(now(), at(30ms));  // one codel at each wake-up
    EXPECT_FALSE(robot.client.receive(1s));
  });
}

TEST(ExecutionRequest, ItsControlCodelMayRefuseItBeforeAnythingHappens) {
  RobotWithTask robot;
  int started = 0;
  robot.module.add_activity<Number, Number>("Running", robot.task, {.exec = for_ever});
  robot.module.add_activity<Number, Number>(
      "Positive", robot.task,
      {.control = [&](const Number& in) { return in.value > 0 ? ok : robot.module.own_report(100); },
       .start = [&](Act&) { return ++started, State::ether; }},
      {"Running"});
  robot.run([&] {
    const std::int32_t running = robot.begin("Running").activity;
    const Reply refused = robot.begin("Positive", -1);
    EXPECT_TRUE(refused.final);
    EXPECT_EQ(code_of(refused.report), 100);
    EXPECT_EQ(refused.activity, -1);
    sleep_for(100ms);
    EXPECT_EQ(started, 0);
    EXPECT_FALSE(robot.client.receive(Duration()));  // nothing was interrupted
    EXPECT_EQ(robot.abort(running), ok);
  });
}

TEST(ExecutionRequest, TheLastOneWins) {
  RobotWithTask robot;
  std::string codels;
  const auto note = [&](char c, State next) {
    return [&codels, c, next](Act& a) {
      codels += c + std::to_string(a.input.value) + " ";
      return next;
    };
  };
  robot.module.add_activity<Number, Number>(
      "Go", robot.task,
      {.start = note('s', State::exec), .exec = note('x', State::exec), .inter = note('i', State::ether)}, {"Go"});
  robot.run([&] {
    const Reply first = robot.begin("Go", 1);
    sleep_for(25ms);
    ASSERT_TRUE(robot.client.send("m", "Go", Number{2}));
    const Reply interrupted = robot.next();  // the new one starts only after this
    EXPECT_EQ(interrupted.send_id, first.send_id);
    EXPECT_TRUE(interrupted.final);
    EXPECT_TRUE(is(interrupted.report, StandardReport::activity_interrupted));
    EXPECT_EQ(now(), at(30ms));
    const Reply second = robot.next();
    EXPECT_FALSE(second.final);
    EXPECT_EQ(now(), at(30ms));
    sleep_for(15ms);
    EXPECT_EQ(codels, "s1 x1 i1 s2 ");
    EXPECT_EQ(robot.abort(second.activity), ok);
  });
}

TEST(ExecutionRequest, OneThatStillWaitsIsInterruptedAtOnce) {
  RobotWithTask robot;
  robot.module.add_activity<Number, Number>("Slow", robot.task, {.exec = for_ever, .inter = [n = 0](Act&) mutable {
                                                                   return ++n < 4 ? State::inter : State::ether;
                                                                 }});
  robot.module.add_activity<Number, Number>("Go", robot.task, {.exec = for_ever}, {"Slow", "Go"});
  robot.run([&] {
    const Reply slow = robot.begin("Slow");
    sleep_for(5ms);
    const auto second = robot.client.send("m", "Go", Number()), third = robot.client.send("m", "Go", Number());
    const Reply of_second = robot.next();
    EXPECT_EQ(of_second.send_id, second);
    EXPECT_TRUE(of_second.final);
    EXPECT_TRUE(is(of_second.report, StandardReport::activity_interrupted));
    EXPECT_EQ(now(), at(5ms));
    EXPECT_EQ(robot.next().send_id, slow.send_id);  // at the fourth wake-up of its INTER codel
    EXPECT_EQ(now(), at(40ms));
    EXPECT_EQ(robot.next().send_id, third);
    EXPECT_EQ(now(), at(40ms));
  });
}

TEST(ExecutionRequest, ActivitiesThatDoNotInterruptEachOtherRunTogether) {
  RobotWithTask robot;
  robot.module.add_activity<Number, Number>("A", robot.task, {.exec = for_ever});
  robot.module.add_activity<Number, Number>("B", robot.task, {.exec = for_ever}, {"A"});
  robot.module.add_activity<Number, Number>("C", robot.task, {.exec = for_ever}, {"B"});
  robot.run([&] {
    const Reply a = robot.begin("A"), c = robot.begin("C");
    EXPECT_NE(a.activity, c.activity);
    EXPECT_FALSE(robot.client.receive(50ms));
    const auto b = robot.client.send("m", "B", Number());
    EXPECT_EQ(robot.next().send_id, a.send_id);  // A is interrupted, C is not
    EXPECT_EQ(robot.next().send_id, *b);
    EXPECT_FALSE(robot.client.receive(50ms));
  });
}

TEST(ControlRequest, MayInterruptActivities) {
  RobotWithTask robot;
  bool refuse = true;
  robot.module.add_activity<Number, Number>("Go", robot.task, {.exec = for_ever});
  robot.module.add_control<Number>(
      "Stop", [&](const Number&, Nothing&) { return refuse ? robot.module.own_report(100) : ok; }, {"Go"});
  robot.run([&] {
    robot.begin("Go");
    robot.begin("Stop");
    EXPECT_FALSE(robot.client.receive(50ms));  // refused: nothing happens
    refuse = false;
    EXPECT_EQ(robot.begin("Stop").report, ok);
    EXPECT_TRUE(is(robot.next().report, StandardReport::activity_interrupted));
  });
}

TEST(InitRequest, MustHaveSucceededBeforeExecutionRequestsAreTaken) {
  RobotWithTask robot;
  robot.module.add_init<Number, Number>("Init", robot.task, {.start = [&](Act& a) {
                                          if (a.input.value == 0) a.report = robot.module.own_report(100);
                                          return State::ether;
                                        }});
  robot.module.add_activity<Number, Number>("Go", robot.task, {});
  robot.module.add_control<Number>("Set", [](const Number&, Nothing&) { return ok; });
  robot.run([&] {
    const auto init = [&](std::int32_t value) {
      EXPECT_FALSE(robot.begin("Init", value).final);
      return robot.next().report;
    };
    EXPECT_TRUE(is(robot.begin("Go").report, StandardReport::wait_init_request));
    EXPECT_EQ(robot.begin("Set").report, ok);
    EXPECT_EQ(code_of(init(0)), 100);
    EXPECT_TRUE(is(robot.begin("Go").report, StandardReport::wait_init_request));
    EXPECT_EQ(init(1), ok);
    EXPECT_FALSE(robot.begin("Go").final);
    EXPECT_EQ(robot.next().report, ok);
  });
}

TEST(ActivityTable, TakesNineteenAndRefusesTheTwentieth) {
  RobotWithTask robot;
  robot.module.add_activity<Number, Number>("Go", robot.task, {.exec = for_ever});
  robot.run([&] {
    std::set<std::int32_t> numbers;
    for (int i = 0; i < 19; ++i) {
      const Reply reply = robot.begin("Go");
      EXPECT_FALSE(reply.final);
      numbers.insert(reply.activity);
    }
    EXPECT_EQ(numbers.size(), 19u);
    const Reply refused = robot.begin("Go");
    EXPECT_TRUE(refused.final);
    EXPECT_TRUE(is(refused.report, StandardReport::too_many_activities));
    EXPECT_EQ(robot.abort(7), ok);
    EXPECT_EQ(robot.next().activity, 7);
    EXPECT_EQ(robot.begin("Go").activity, 7);
  });
}

TEST(ActivityTable, NumbersGoRound) {
  RobotWithTask robot;
  robot.module.add_activity<Number, Number>("Go", robot.task, {});
  robot.run([&] {
    for (int i = 0; i < 45; ++i) {
      EXPECT_EQ(robot.begin("Go").activity, i % 19);
      robot.next();
    }
  });
}

TEST(Abort, EndsAnActivityAndKnowsWhichThereAre) {
  RobotWithTask robot;
  robot.module.add_activity<Number, Number>("Go", robot.task, {.exec = for_ever});
  robot.run([&] {
    const Reply go = robot.begin("Go");
    for (const std::int32_t unknown : {19, 1000, -1, -100})
      EXPECT_TRUE(is(robot.abort(unknown), StandardReport::unknown_activity)) << unknown;
    EXPECT_TRUE(is(robot.abort(go.activity + 1), StandardReport::activity_already_ended));
    EXPECT_EQ(robot.abort(go.activity), ok);
    EXPECT_TRUE(is(robot.next().report, StandardReport::activity_interrupted));
    EXPECT_TRUE(is(robot.abort(go.activity), StandardReport::activity_already_ended));
  });
}

TEST(Abort, EndsTheModuleWhenNoActivityRuns) {
  RobotWithTask robot;
  ExecutionTask& aperiodic = robot.module.add_task("aperiodic", {});
  std::string ends;
  robot.task.set_end([&] { ends += "main "; });
  aperiodic.set_end([&] { ends += "aperiodic "; });
  robot.module.add_activity<Number, Number>("Go", robot.task, {.exec = for_ever});
  robot.run([&] {
    const Reply go = robot.begin("Go");
    EXPECT_TRUE(is(robot.abort(AbortInput::end_module), StandardReport::system_error));
    EXPECT_EQ(robot.abort(go.activity), ok);
    robot.next();
    EXPECT_EQ(robot.abort(AbortInput::end_module), ok);
    robot.module.join();
    EXPECT_EQ(ends, "aperiodic main ");
    EXPECT_LE(now(), at(20ms));
  });
}

TEST(Requests, WithAnInputOfAnotherTypeAreASystemError) {
  RobotWithTask robot;
  robot.module.add_activity<Number, Number>("Go", robot.task, {});
  robot.module.add_control<Number>("Set", [](const Number&, Nothing&) { return ok; });
  robot.run([&] {
    EXPECT_TRUE(is(robot.client.call("m", "Go", Nothing()).report, StandardReport::system_error));
    EXPECT_TRUE(is(robot.client.call("m", "Set", AbortInput()).report, StandardReport::system_error));
    EXPECT_EQ(robot.client.call("m", "Set", Number()).report, ok);
  });
}

TEST(RequestsDeathTest, ToWhatDoesNotExistAreBugs) {
  TestRobot robot;
  robot.run([&] {
    EXPECT_DEATH(robot.client.send("nobody", "Abort"), "a module that does not exist");
    EXPECT_DEATH(robot.client.send("m", "Nothing"), "that the module does not have");
  });
  EXPECT_DEATH(robot.module.add_control<Number>("Abort", [](const Number&, Nothing&) { return ok; }),
               "two requests of one name");
}

TEST(Reports, AreTheModulesNumberAndGenomsCodes) {
  EXPECT_EQ(make_report(42, StandardReport::activity_interrupted), 42u << 16 | 1);
  EXPECT_EQ(make_report(42, StandardReport::exec_task_suspended), 42u << 16 | 11);
  EXPECT_STREQ(name(ok), "ok");
  EXPECT_STREQ(name(make_report(1, StandardReport::wait_init_request)), "WAIT_INIT_RQST");
  EXPECT_STREQ(name(make_report(1, StandardReport::exec_task_suspended)), "EXEC_TASK_SUSPENDED");
  EXPECT_STREQ(name(make_report(1, first_own_report)), "own report");
}

}  // namespace
}  // namespace waitpoint::genom
