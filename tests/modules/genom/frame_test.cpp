// SPDX-License-Identifier: BSD-3-Clause
// The frame on threads of either kind: properties that do not depend on timing.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "tests/modules/genom/frame_robot.hpp"
#include "tests/modules/on_threads.hpp"

namespace waitpoint::genom {
namespace {

using namespace std::chrono_literals;
using threads::this_thread::sleep_for;
using Act = Running<Number, Number>;

struct Pair {
  std::int32_t a = 0, b = 0;
  static void fields(auto field) {
    field("a", &Pair::a);
    field("b", &Pair::b);
  }
};

// Runs until it is interrupted.
State for_ever(Act&) { return State::exec; }

struct RobotWithTask : FrameRobot {
  ExecutionTask& task = module.add_task("main", {.period_ms = 10ms});
};

struct EchoRobot : FrameRobot {
  EchoRobot() {
    module.add_control<Number, Number>("Echo", [](const Number& in, Number& out) { return out = in, ok; });
  }
};

TEST(Client, RepliesGoToTheSender) {
  on_threads([] {
    EchoRobot robot;
    robot.run([&] {
      const auto first = robot.client.send("m", "Echo", Number{1});
      EXPECT_TRUE(robot.other.send("m", "Echo", Number{2}));
      EXPECT_TRUE(robot.other.send("m", "Echo", Number{3}));
      const Reply reply = robot.next();
      EXPECT_EQ(reply.send_id, first);
      EXPECT_EQ(reply.output.as<Number>().value, 1);
      EXPECT_EQ(robot.other.receive()->output.as<Number>().value, 2);
      EXPECT_EQ(robot.other.receive()->output.as<Number>().value, 3);
    });
  });
}

TEST(Client, ManyTasksAskAtOnceAndEachGetsItsOwnReplies) {
  on_threads([] {
    EchoRobot robot;
    robot.run([&] {
      constexpr std::int32_t clients = 4;
      std::vector<threads::thread> all;
      all.reserve(clients);
      for (std::int32_t i = 0; i < clients; ++i)
        all.emplace_back([&robot, i] {
          Client client(robot.names, "asker");
          for (std::int32_t k = 0; k < 50; ++k)
            EXPECT_EQ(client.call("m", "Echo", Number{100 * i + k}).output.as<Number>().value, 100 * i + k);
        });
      for (threads::thread& thread : all) thread.join();
    });
  });
}

TEST(Poster, ReadersNeverSeeHalfAValueNorAnOlderOneThanBefore) {
  on_threads([] {
    FrameRobot robot;
    ExecutionTask& task = robot.module.add_task("main", {.period_ms = 1ms});
    OutputPoster<Pair>& poster = robot.module.add_poster<Pair>("pair", task);
    PosterLink<Pair>& link = robot.module.read_poster<Pair>("pair");
    task.set_permanent([&poster, k = 0]() mutable { poster.write({++k, -k}); });
    robot.run([&] {
      Pair pair;
      Time date;
      for (int reads = 0; pair.a < 50; ++reads) {
        const Pair before = pair;
        const Time date_before = date;
        link.read(pair, &date);
        ASSERT_EQ(pair.a, -pair.b);
        ASSERT_GE(pair.a, before.a);
        ASSERT_GE(date, date_before);
        ASSERT_LE(date, threads::now());
        if (reads % 100 == 0) sleep_for(100us);
      }
    });
  });
}

TEST(ControlRequest, ReportsWhatItsCodelSays) {
  on_threads([] {
    FrameRobot robot;
    robot.module.add_control<Number>("Refuse", [&](const Number&, Nothing&) { return robot.module.own_report(101); });
    robot.run([&] {
      const Reply reply = robot.begin("Refuse");
      EXPECT_EQ(module_of(reply.report), ScriptedModule::number);
      EXPECT_EQ(code_of(reply.report), 101);
      EXPECT_STREQ(name(reply.report), "own report");
    });
  });
}

TEST(ControlRequest, MayInterruptActivities) {
  on_threads([] {
    RobotWithTask robot;
    bool refuse = true;
    robot.module.add_activity<Number, Number>("Go", robot.task, {.exec = for_ever});
    robot.module.add_control<Number>(
        "Stop", [&](const Number&, Nothing&) { return refuse ? robot.module.own_report(100) : ok; }, {"Go"});
    robot.run([&] {
      robot.begin("Go");
      robot.begin("Stop");
      EXPECT_FALSE(robot.client.receive(50ms));  // rejected: nothing happens
      refuse = false;
      EXPECT_EQ(robot.begin("Stop").report, ok);
      EXPECT_TRUE(is(robot.next().report, StandardReport::activity_interrupted));
    });
  });
}

TEST(InitRequest, MustHaveSucceededBeforeExecutionRequestsAreTaken) {
  on_threads([] {
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
  });
}

TEST(ExecutionRequest, ItsControlCodelMayRefuseItBeforeAnythingHappens) {
  on_threads([] {
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
  });
}

TEST(Activity, CallsItsCodelsStateByState) {
  on_threads([] {
    RobotWithTask robot;
    std::string trace;
    // Each state lasts for one codel.
    const auto codel = [&trace](char letter, State state, State next) {
      return [&trace, letter, state, next](Act& act) {
        trace += letter;
        return ++act.output.value % 2 == 1 ? state : next;
      };
    };
    robot.module.add_activity<Number, Number>("Go", robot.task,
                                              {.start = codel('s', State::start, State::exec),
                                               .exec = codel('x', State::exec, State::end),
                                               .end = codel('e', State::end, State::ether)});
    robot.run([&] {
      robot.begin("Go");
      EXPECT_EQ(robot.next().output.as<Number>().value, 6);
      EXPECT_EQ(trace, "ssxxee");
    });
  });
}

TEST(ActivityTable, TakesNineteenAndRefusesTheTwentieth) {
  on_threads([] {
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
  });
}

TEST(ActivityTable, NumbersGoRound) {
  on_threads([] {
    RobotWithTask robot;
    robot.module.add_activity<Number, Number>("Go", robot.task, {});
    robot.run([&] {
      for (int i = 0; i < 45; ++i) {
        EXPECT_EQ(robot.begin("Go").activity, i % 19);
        robot.next();
      }
    });
  });
}

TEST(Abort, EndsAnActivityAndKnowsWhichThereAre) {
  on_threads([] {
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
  });
}

TEST(Requests, WithAnInputOfAnotherTypeAreASystemError) {
  on_threads([] {
    RobotWithTask robot;
    robot.module.add_activity<Number, Number>("Go", robot.task, {});
    robot.module.add_control<Number>("Set", [](const Number&, Nothing&) { return ok; });
    robot.run([&] {
      EXPECT_TRUE(is(robot.client.call("m", "Go", Nothing()).report, StandardReport::system_error));
      EXPECT_TRUE(is(robot.client.call("m", "Set", AbortInput()).report, StandardReport::system_error));
      EXPECT_EQ(robot.client.call("m", "Set", Number()).report, ok);
    });
  });
}

// A running activity, one that does not leave its INTER codel at once, one that waits for it, and one that has failed.
TEST(EndOfAModule, ComesWhateverItDoes) {
  on_threads([] {
    RobotWithTask robot;
    int ends = 0;
    robot.task.set_end([&] { ++ends; });
    robot.module.add_task("aperiodic", {}).set_end([&] { ++ends; });
    robot.module.add_activity<Number, Number>("Go", robot.task, {.exec = for_ever});
    robot.module.add_activity<Number, Number>("Slow", robot.task, {.exec = for_ever, .inter = [n = 0](Act&) mutable {
                                                                     return ++n < 4 ? State::inter : State::ether;
                                                                   }});
    robot.module.add_activity<Number, Number>("Instead", robot.task, {.exec = for_ever}, {"Slow"});
    robot.module.add_activity<Number, Number>("Fail", robot.task, {.exec = [](Act&) { return State::fail; }});
    robot.run([&] {
      for (const char* request : {"Go", "Fail", "Slow", "Instead"})
        EXPECT_TRUE(robot.client.send("m", request, Number()));
    });
    EXPECT_EQ(ends, 2);
  });
}

TEST(EndOfAModule, ComesWhenATaskIsSuspended) {
  on_threads([] {
    RobotWithTask robot;
    robot.module.add_activity<Number, Number>("Go", robot.task, {.exec = for_ever});
    robot.module.add_activity<Number, Number>("Wrong", robot.task, {.exec = [](Act&) { return State::start; }});
    robot.run([&] {
      robot.begin("Go");
      robot.begin("Wrong");
      EXPECT_TRUE(is(robot.next().report, StandardReport::forbidden_activity_transition));
    });
  });
}

TEST(EndOfAModule, IsGivenUpWhereAnActivityGoesOn) {
  on_threads([] {
    RobotWithTask robot;
    robot.module.add_activity<Number, Number>("Slow", robot.task, {.exec = for_ever, .inter = [n = 0](Act&) mutable {
                                                                     return ++n < 40 ? State::inter : State::ether;
                                                                   }});
    robot.run([&] {
      robot.begin("Slow");
      EXPECT_FALSE(robot.other.end_module("m", 50ms));
      EXPECT_TRUE(is(robot.next().report, StandardReport::activity_interrupted));
      EXPECT_FALSE(robot.begin("Slow").final);  // the module keeps running
    });
  });
}

}  // namespace
}  // namespace waitpoint::genom
