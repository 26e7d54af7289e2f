// SPDX-License-Identifier: BSD-3-Clause
// Kinds of requests and their replies, rejections by a control task, and interruptions between activities.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/modules/genom/scripted_module.hpp"

namespace waitpoint::genom {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;
using Act = Running<Number, Number>;

// Runs until it is interrupted.
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

TEST(ModuleWatch, IsToldWhatTheModuleIsAskedAndWhatBecomesOfIt) {
  struct Lines : ModuleWatch {
    void on(const Module& module, const ModuleEvent& event) override {
      constexpr const char* kinds[] = {"asked", "started", "ended"};
      lines.push_back(to_string(event.date) + " " + module.name() + "." + event.request.name + " " +
                      kinds[static_cast<int>(event.kind)] + " " + genom::name(event.report));
    }
    std::vector<std::string> lines;
  } watch;
  RobotWithTask robot;
  robot.module.add_control<Number>("Set", [](const Number&, Nothing&) { return ok; });
  robot.module.add_activity<Number, Number>("Go", robot.task, {.exec = for_ever}, {"Go"});
  robot.module.set_watch(&watch);
  robot.run([&] {
    sleep_for(1ms);
    robot.begin("Set");
    robot.begin("Go");
    sleep_for(30ms);
    robot.client.send("m", "Go", Number{});
    robot.next();  // of the first one, which is interrupted
    robot.next();
  });
  EXPECT_EQ(watch.lines, (std::vector<std::string>{
                             "0.001000000 m.Set asked ok", "0.001000000 m.Set ended ok", "0.001000000 m.Go asked ok",
                             "0.001000000 m.Go started ok", "0.031000000 m.Go asked ok",
                             "0.040000000 m.Go ended ACTIVITY_INTERRUPTED", "0.040000000 m.Go started ok"}));
}

}  // namespace
}  // namespace waitpoint::genom
