// SPDX-License-Identifier: BSD-3-Clause
// Execution tasks: their wake-ups, the order of their calls, and their costs.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/modules/genom/scripted_module.hpp"

namespace waitpoint::genom {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;
using Act = Running<Number, Number>;

std::int64_t ms() { return now().ns() / 1'000'000; }

TEST(ExecutionTask, CallsItsCodelsInGenomsOrder) {
  TestRobot robot;
  std::string trace;
  const auto note = [&](std::string what) { return [&trace, what] { trace += what + " "; }; };
  ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms});
  task.set_start(note("start"));
  task.set_permanent(note("first"));
  task.set_second_permanent(note("second"));
  task.set_end(note("end"));
  robot.module.add_activity<Number, Number>("Go", task, {.exec = [&](Act& act) {
                                              trace += std::to_string(act.number) + " ";
                                              return State::exec;
                                            }});
  robot.run([&] {
    robot.begin("Go");
    robot.begin("Go");
    sleep_for(25ms);
    EXPECT_EQ(trace, "start first 0 1 second first 0 1 second ");
    robot.abort(0);
    robot.abort(1);
    sleep_for(10ms);
    EXPECT_EQ(robot.abort(AbortInput::end_module), ok);
    robot.module.join();
    EXPECT_EQ(trace, "start first 0 1 second first 0 1 second first second end ");
  });
}

TEST(ExecutionTask, WakesAtItsPeriodAndDelayWhichAScenarioMaySet) {
  const auto wake_ups = [](std::vector<Setting> settings) {
    TestRobot robot(std::move(settings));
    std::vector<std::int64_t> times;
    robot.module.add_task("main", {.period_ms = 20ms, .delay_ms = 5ms}).set_permanent([&] { times.push_back(ms()); });
    robot.setup.settings.check_all_used();
    robot.run([&] { sleep_for(70ms); });
    return times;
  };
  EXPECT_EQ(wake_ups({}), (std::vector<std::int64_t>{5, 25, 45, 65}));
  EXPECT_EQ(wake_ups({{"tasks.main.period_ms", "30", "f", 1}, {"tasks.main.delay_ms", "2", "f", 2}}),
            (std::vector<std::int64_t>{2, 32, 62}));
}

TEST(ExecutionTask, AnAperiodicOneIsWokenByEachLetter) {
  TestRobot robot;
  std::vector<std::int64_t> times;
  robot.module.add_task("main", {}).set_permanent([&] { times.push_back(ms()); });
  robot.run([&] {
    for (int i = 0; i < 3; ++i) {
      sleep_for(7ms);
      robot.abort(0);
    }
    sleep_for(100ms);
    EXPECT_EQ(times, (std::vector<std::int64_t>{7, 14, 21}));
  });
}

// One signal wakes the task once; further signals before it wakes do not count: else they would accumulate.
TEST(ExecutionTask, AnAperiodicOneWithSeveralActivitiesWakesOnceForEachStep) {
  TestRobot robot;
  int wake_ups = 0;
  ExecutionTask& task = robot.module.add_task("main", {});
  task.set_permanent([&] { ++wake_ups; });
  robot.module.add_activity<Number, Number>("Go", task, {.exec = [](Act& act) {
                                              compute(1ms);
                                              return ++act.output.value < 100 ? State::exec : State::ether;
                                            }});
  robot.run([&] {
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(robot.client.send("m", "Go", Number()));
    for (int i = 0; i < 10; ++i) robot.next();
    sleep_for(1s);
    EXPECT_GE(wake_ups, 100);
    EXPECT_LE(wake_ups, 110);
  });
}

TEST(ExecutionTask, MissedPeriodsAreCountedAndNotMadeUpFor) {
  TestRobot robot;
  std::vector<std::int64_t> times;
  ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms, .cost_us = 1ms});
  task.set_permanent([&] {
    times.push_back(ms());
    if (times.size() == 2) compute(34ms);
  });
  robot.run([&] {
    sleep_for(75ms);
    EXPECT_EQ(times, (std::vector<std::int64_t>{10, 20, 55, 60, 70}));
    EXPECT_EQ(task.missed_periods(), 2);  // those of 30 and 40 ms; the one of 50 ms was late
    robot.abort(0);
    ModuleStatus status;
    static_cast<Poster<ModuleStatus>*>(robot.names.find_poster("m.control"))->read(status);
    EXPECT_EQ(status.missed_periods, 2u);
  });
}

// The work of the tick at 10 ms ends at 25 ms, 5 ms late; that of 20 ms at 40 ms, 10 ms late; by then the ticks of 30
// and 40 ms are both due, and are served as one.
TEST(ExecutionTask, MissedDeadlinesAreCountedWithTheGreatestLateness) {
  TestRobot robot;
  ExecutionTask& late = robot.module.add_task("late", {.period_ms = 10ms, .cost_us = 15ms});
  late.set_permanent([] {});
  robot.run([&] {
    sleep_for(26ms);
    EXPECT_EQ(late.missed_deadlines(), 1);
    EXPECT_EQ(late.missed_periods(), 0);
    EXPECT_EQ(late.greatest_lateness(), Duration(5ms));
    sleep_for(15ms);
    EXPECT_EQ(late.missed_deadlines(), 2);
    EXPECT_EQ(late.missed_periods(), 1);
    EXPECT_EQ(late.greatest_lateness(), Duration(10ms));
  });
}

TEST(ExecutionTask, WorkThatIsDoneAtTheNextTickIsInTime) {
  TestRobot robot;
  ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms, .delay_ms = 3ms, .cost_us = 10ms});
  task.set_permanent([] {});
  robot.run([&] {
    sleep_for(100ms);
    EXPECT_EQ(task.missed_deadlines(), 0);
    EXPECT_EQ(task.greatest_lateness(), Duration());
  });
}

TEST(Module, ACostThatNoCodelHasIsRefused) {
  TestRobot robot({{"tasks.main.cost_us", "300", "robot.yaml", 7}});
  ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms});
  std::string complaint;
  try {
    robot.module.check_costs(robot.setup.settings);
  } catch (const BadInput& error) {
    complaint = error.what();
  }
  EXPECT_EQ(
      complaint,
      "robot.yaml:7: expected 'tasks.main.cost_us' to be left out (the task has no permanent codel), found '300'");
  task.set_second_permanent([] {});
  EXPECT_NO_THROW(robot.module.check_costs(robot.setup.settings));
}

// Both locks are held during all codels: in virtual time, too, each begins where the previous one ended.
TEST(ExecutionTask, CodelsOfOneModuleNeverOverlapInAnyOrder) {
  for (std::uint64_t seed = 0; seed <= 10; ++seed) {
    TestRobot robot;
    struct Span {
      Time begin, end;
    };
    std::vector<Span> spans;
    const auto codel = [&](Duration cost) {
      const Time begin = now();
      compute(cost);
      spans.push_back({begin, now()});
    };
    ExecutionTask& a = robot.module.add_task("a", {.period_ms = 5ms});
    ExecutionTask& b = robot.module.add_task("b", {.period_ms = 7ms});
    a.set_permanent([&] { codel(1700us); });
    b.set_permanent([&] { codel(2900us); });
    robot.module.add_activity<Number, Number>("Go", b, {.exec = [&](Act&) { return codel(600us), State::exec; }});
    robot.module.add_control<Number>("Set", [&](const Number&, Nothing&) { return codel(250us), ok; });
    robot.run(
        [&] {
          robot.begin("Go");
          for (int i = 0; i < 50; ++i) {
            robot.other.call("m", "Set", Number());
            sleep_for(1100us);
          }
        },
        {seed == 0 ? kernel::Order::fifo : kernel::Order::seeded, seed, ""});
    EXPECT_GT(spans.size(), 70u);
    for (std::size_t i = 1; i < spans.size(); ++i) EXPECT_GE(spans[i].begin, spans[i - 1].end);
  }
}

TEST(ExecutionTask, EachActivitysCodelCostsWhatItsRequestDeclares) {
  TestRobot robot;
  std::vector<std::int64_t> times;
  ExecutionTask& task = robot.module.add_task("main", {.period_ms = 100ms});
  const auto add = [&](const char* name, Duration cost) {
    robot.module
        .add_activity<Number, Number>(name, task, {.exec = [&](Act&) { return times.push_back(ms()), State::exec; }})
        .cost = cost;
  };
  add("Cheap", 3ms);
  add("Dear", 20ms);
  robot.run([&] {
    robot.begin("Cheap");
    robot.begin("Dear");
    robot.begin("Cheap");
    sleep_for(250ms);
    EXPECT_EQ(times, (std::vector<std::int64_t>{100, 103, 123, 200, 203, 223}));
  });
}

TEST(ExecutionTask, RunsAreRepeatable) {
  const auto digest = [](std::uint64_t seed) {
    TestRobot robot;
    ExecutionTask& task = robot.module.add_task("main", {.period_ms = 10ms, .cost_us = 200us});
    robot.module.add_poster<Number>("number", task);
    robot.module.add_activity<Number, Number>(
        "Go", task, {.exec = [](Act& act) { return ++act.output.value < 5 ? State::exec : State::ether; }});
    return to_string(robot
                         .run(
                             [&] {
                               for (int i = 0; i < 5; ++i) robot.client.call("m", "Go", Number());
                             },
                             {seed == 0 ? kernel::Order::fifo : kernel::Order::seeded, seed, ""})
                         .digest);
  };
  std::vector<std::string> digests;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    digests.push_back(digest(seed));
    EXPECT_EQ(digest(seed), digests.back());
  }
  std::sort(digests.begin(), digests.end());
  EXPECT_EQ(std::unique(digests.begin(), digests.end()), digests.end());
}

}  // namespace
}  // namespace waitpoint::genom
