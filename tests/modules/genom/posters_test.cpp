// SPDX-License-Identifier: BSD-3-Clause
// Posters: their dates, permissions to link to them, and the values that readers see over time.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/modules/genom/scripted_module.hpp"

namespace waitpoint::genom {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;
using this_thread::sleep_until;
using Act = Running<Number, Number>;

struct Pair {
  std::int32_t a = 0, b = 0;
  static void fields(auto field) {
    field("a", &Pair::a);
    field("b", &Pair::b);
  }
};

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

// The message of `call` must contain `part`.
void expect_bad_input(const std::function<void()>& call, const std::string& part) {
  const std::string message = message_of(call);
  EXPECT_NE(message.find(part), std::string::npos) << "'" << message << "' lacks '" << part << "'";
}

TEST(Poster, IsDatedAndSeenWhenTheCodelThatWroteItHasCostItsTime) {
  TestRobot robot;
  ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms});
  OutputPoster<Number>& poster = robot.module.add_poster<Number>("number", task);
  PosterLink<Number>& link = robot.module.read_poster<Number>("number");
  robot.module
      .add_activity<Number, Number>("Go", task,
                                    {.exec =
                                         [&](Act& act) {
                                           poster.write(act.input);
                                           return State::ether;
                                         }})
      .cost = 4ms;
  robot.run([&] {
    Number number;
    Time date;
    EXPECT_EQ(link.read(number, &date), PosterStatus::empty);
    robot.begin("Go", 17);
    sleep_until(at(14ms - 1ns));
    EXPECT_EQ(link.read(number, &date), PosterStatus::empty);
    sleep_until(at(14ms + 1ns));
    EXPECT_EQ(link.read(number, &date), PosterStatus::ok);
    EXPECT_EQ(number.value, 17);
    EXPECT_EQ(date, at(14ms));
  });
}

TEST(Poster, PermanentCodelDatesItAfterTheCodelsCost) {
  TestRobot robot;
  ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms, .cost_us = 300us});
  OutputPoster<Number>& poster = robot.module.add_poster<Number>("number", task);
  task.set_permanent([&] { poster.write({1}); });
  task.set_second_permanent([] { compute(2ms); });
  PosterLink<Number>& link = robot.module.read_poster<Number>("number");
  robot.run([&] {
    sleep_for(15ms);
    Number number;
    Time date;
    EXPECT_EQ(link.read(number, &date), PosterStatus::ok);
    EXPECT_EQ(date, at(10300us));
  });
}

TEST(Poster, AnAutomaticOneFollowsItsVariableAtEveryWakeUp) {
  TestRobot robot;
  Number variable{5};
  ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms, .cost_us = 1ms});
  robot.module.add_poster<Number>("number", task, &variable);
  task.set_permanent([&] { ++variable.value; });
  PosterLink<Number>& link = robot.module.read_poster<Number>("m.number");
  robot.run([&] {
    for (int k = 1; k <= 3; ++k) {
      sleep_until(at(k * 10ms + 5ms));
      Number number;
      Time date;
      EXPECT_EQ(link.read(number, &date), PosterStatus::ok);
      EXPECT_EQ(number.value, 5 + k);
      EXPECT_EQ(date, at(k * 10ms + 1ms));
    }
  });
}

TEST(Poster, ReadersNeverSeeHalfAValue) {
  for (std::uint64_t seed = 0; seed <= 10; ++seed) {
    TestRobot robot;
    ExecutionTask& task = robot.module.add_task("main", {.period_ms = 1ms});
    OutputPoster<Pair>& poster = robot.module.add_poster<Pair>("pair", task);
    PosterLink<Pair>& link = robot.module.read_poster<Pair>("pair");
    int k = 0;
    task.set_permanent([&] { poster.write({++k, -k}); });
    robot.run(
        [&] {
          for (int i = 0; i < 100; ++i) {
            sleep_for(500us);
            Pair pair;
            link.read(pair);
            ASSERT_EQ(pair.a, -pair.b);
          }
        },
        {seed == 0 ? kernel::Order::fifo : kernel::Order::seeded, seed, ""});
    EXPECT_GE(k, 49);
  }
}

TEST(Poster, WrittenValuesArePartOfTheDigest) {
  const auto digest = [](std::int32_t value, const char* name) {
    TestRobot robot;
    ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms});
    OutputPoster<Number>& poster = robot.module.add_poster<Number>(name, task);
    task.set_permanent([&poster, value] { poster.write({value}); });
    return to_string(robot.run([&] { sleep_for(15ms); }).digest);
  };
  EXPECT_EQ(digest(1, "p"), digest(1, "p"));
  EXPECT_NE(digest(1, "p"), digest(2, "p"));
  EXPECT_NE(digest(1, "p"), digest(1, "q"));
}

TEST(PosterLink, RequiredPosterWithoutAWriterIsBadInput) {
  TestRobot robot;
  robot.module.read_poster<Number>("rflex.odometry");
  expect_bad_input([&] { robot.module.connect(); },
                   "module 'm': reads poster 'rflex.odometry', which no module of this robot writes");
}

TEST(PosterLink, ToAnotherTypeIsBadInput) {
  TestRobot robot;
  robot.names.create_poster<Pair>("rflex.odometry", "rflex");
  robot.module.read_poster<Number>("rflex.odometry");
  expect_bad_input([&] { robot.module.connect(); },
                   "reads poster 'rflex.odometry' as another type than 'rflex' writes");
}

TEST(PosterLink, OptionalPosterWithoutAWriterReadsAsEmpty) {
  TestRobot robot;
  PosterLink<Number>& link = robot.module.read_poster<Number>("sick.echoes", false);
  robot.run([&] {
    Number number{3};
    EXPECT_FALSE(link.connected());
    EXPECT_EQ(link.read(number), PosterStatus::empty);
    EXPECT_EQ(number.value, 3);
  });
  TestRobot wrong;
  wrong.names.create_poster<Pair>("sick.echoes", "sick");
  wrong.module.read_poster<Number>("sick.echoes", false);
  expect_bad_input([&] { wrong.module.connect(); }, "as another type");
}

TEST(NameSpace, TwoPostersOrModulesOfOneNameAreBadInput) {
  TestRobot robot;
  robot.names.create_poster<Pair>("a.b", "a");
  expect_bad_input([&] { robot.names.create_poster<Number>("a.b", "c"); },
                   "poster 'a.b': written by 'a' and by another");
  EXPECT_NE(dynamic_cast<Poster<Pair>*>(robot.names.find_poster("a.b")), nullptr);
  EXPECT_EQ(robot.names.find_poster("a.c"), nullptr);
  ModuleSetup again{robot.names, "m", {}};
  EXPECT_NE(message_of([&] { ScriptedModule{again}; }), "");
  EXPECT_EQ(robot.names.find_module("m"), &robot.module);
  EXPECT_EQ(robot.names.find_module("n"), nullptr);
}

TEST(NameSpace, RobotsHaveSeparateNameSpaces) {
  TestRobot one, two;
  EXPECT_NE(one.names.find_module("m"), two.names.find_module("m"));
  EXPECT_NE(one.names.find_poster("m.control"), two.names.find_poster("m.control"));
}

}  // namespace
}  // namespace waitpoint::genom
