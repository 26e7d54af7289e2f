// SPDX-License-Identifier: BSD-3-Clause
// A scenario's settings for the tasks of a module: local clocks, processors, latency of hardware.
#include <gtest/gtest.h>

#include "tests/modules/genom/scripted_module.hpp"

namespace waitpoint::genom {
namespace {

using namespace std::chrono_literals;

// A module with one task of 10 ms, whose codel costs 1 ms, on a robot with the processor "cpu".
struct ComputingRobot {
  explicit ComputingRobot(std::vector<Setting> settings)
      : cpu(names.add_processor("cpu")), setup{names, "m", Settings(std::move(settings))}, module(setup) {
    task = &module.add_task("main", {.period_ms = 10ms, .cost_us = 1ms});
    setup.settings.check_all_used();
  }
  NameSpace names;
  threads::processor& cpu;
  ModuleSetup setup;
  ScriptedModule module;
  ExecutionTask* task;
};

// Time in microseconds at which the codel of the first wake-up, at 10 ms, ends; from 10 ms on a more urgent task
// computes for 2 ms on the robot's processor.
std::int64_t end_of_codel_us(std::vector<Setting> settings, SimulationOptions options = {}) {
  ComputingRobot robot(std::move(settings));
  OutputPoster<Number>& poster = robot.module.add_poster<Number>("value", *robot.task);
  robot.task->set_permanent([&] { poster.write({1}); });
  Time date;
  const waitpoint::Report report = simulate(
      [&] {
        robot.module.start();
        thread({.service = true, .on = &robot.cpu, .priority = 5}, [] {
          this_thread::sleep_until(Time() + Duration(10ms));
          compute(2ms);
          this_thread::sleep_for(1s);
        }).detach();
        this_thread::sleep_until(Time() + Duration(20ms));
        Number number;
        auto& written = dynamic_cast<Poster<Number>&>(*robot.names.find_poster("m.value"));
        EXPECT_EQ(written.read(number, &date), PosterStatus::ok);
      },
      std::move(options));
  EXPECT_TRUE(report.passed) << report;
  return date.ns() / 1000 - 10'000;
}

TEST(TaskComputing, AClockOfTheScenariosChoiceSaysWhatACodelCosts) {
  const auto clock = [](const char* key, const char* text) {
    return Setting{std::string("tasks.main.clock") + key, text, "f", 1};
  };
  EXPECT_EQ(end_of_codel_us({}), 1000);
  EXPECT_EQ(end_of_codel_us({clock("", "fixed")}), 1000);
  EXPECT_EQ(end_of_codel_us({clock(".scale", "x0.5")}), 500);
  EXPECT_EQ(end_of_codel_us({clock(".scale", "2.5")}), 2500);
  const std::vector<Setting> interval = {clock(".kind", "interval"), clock(".cost_us.0", "100"),
                                         clock(".cost_us.1", "300.5"), clock(".scale", "x2")};
  EXPECT_EQ(end_of_codel_us(interval), 601);
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    const std::int64_t us = end_of_codel_us(interval, {kernel::Order::seeded, seed, ""});
    EXPECT_TRUE(us >= 200 && us < 601) << us;
  }
  EXPECT_LT(end_of_codel_us({clock("", "cpu")}), 900);  // declared costs are ignored
  EXPECT_LT(end_of_codel_us({clock(".kind", "proportional"), clock(".scale", "x0")}), 1);
  EXPECT_EQ(end_of_codel_us({clock(".kind", "counted"), clock(".block_cost_ns", "5")}), 0);  // it is not instrumented
}

TEST(TaskComputing, TasksShareAProcessorByTheirPriorities) {
  const auto on = [](const char* key, const char* text) { return Setting{key, text, "f", 1}; };
  EXPECT_EQ(end_of_codel_us({on("processor", "cpu"), on("priority", "4")}), 3000);
  EXPECT_EQ(end_of_codel_us({on("processor", "cpu"), on("priority", "6")}), 1000);
  EXPECT_EQ(end_of_codel_us({on("processor", "cpu"), on("priority", "4"), on("tasks.main.priority", "6")}), 1000);
  EXPECT_EQ(end_of_codel_us({on("tasks.main.processor", "cpu")}), 3000);
  EXPECT_EQ(end_of_codel_us({on("tasks.control.processor", "cpu")}), 1000);
}

// The frame holds a module's locks during its codels: the urgent control task waits for the execution task, which waits
// for every task that is more urgent than itself: priority inversion, as long as that task computes.
TEST(TaskComputing, AModulesLocksMakeForPriorityInversion) {
  const auto replied_at = [](Duration middle_computes) {
    ComputingRobot robot({{"processor", "cpu", "f", 1},
                          {"tasks.main.priority", "1", "f", 2},
                          {"tasks.main.cost_us", "4000", "f", 3},
                          {"tasks.control.priority", "9", "f", 4}});
    robot.task->set_permanent([] {});
    robot.module.add_control<Number>("Ask", [](const Number&, Nothing&) { return ok; });
    Time replied;
    const waitpoint::Report report = simulate([&] {
      robot.module.start();
      thread({.service = true, .on = &robot.cpu, .priority = 5}, [&] {
        this_thread::sleep_until(Time() + Duration(12ms));
        compute(middle_computes);
      }).detach();
      this_thread::sleep_until(Time() + Duration(11ms));  // main has been computing since 10 ms, for 4 ms
      Client client(robot.names, "asker");
      EXPECT_EQ(client.call("m", "Ask", Number{1}).report, ok);
      replied = now();
    });
    EXPECT_TRUE(report.passed) << report;
    return replied;
  };
  EXPECT_EQ(replied_at({}), Time() + Duration(14ms));
  EXPECT_EQ(replied_at(5ms), Time() + Duration(19ms));
  EXPECT_EQ(replied_at(50ms), Time() + Duration(64ms));
}

TEST(TaskComputing, InvalidSettingsAreReportedWithTheirLine) {
  const auto complaint = [](const std::vector<std::pair<std::string, std::string>>& written) -> std::string {
    std::vector<Setting> settings;
    for (const auto& [key, text] : written)
      settings.push_back({"tasks.main." + key, text, "robot.yaml", static_cast<int>(settings.size()) + 1});
    try {
      ComputingRobot robot(std::move(settings));
    } catch (const BadInput& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(
      complaint({{"clock", "quartz"}}),
      "robot.yaml:1: expected 'tasks.main.clock' to be fixed, proportional, cpu, interval or counted, found 'quartz'");
  EXPECT_EQ(complaint({{"clock.kind", "Fixed"}}),
            "robot.yaml:1: expected 'tasks.main.clock.kind' to be fixed, proportional, cpu, interval or counted, found "
            "'Fixed'");
  EXPECT_EQ(complaint({{"clock.kind", "interval"}, {"clock.cost_us.0", "300"}, {"clock.cost_us.1", "100"}}),
            "robot.yaml:2: expected 'tasks.main.clock.cost_us.0' to be the least cost, not above the greatest, found "
            "'300'");
  EXPECT_EQ(
      complaint({{"clock.kind", "interval"}, {"clock.cost_us.0", "-1"}, {"clock.cost_us.1", "100"}}),
      "robot.yaml:2: expected 'tasks.main.clock.cost_us.0' to be a duration that is not negative, at most 1e9 s, found "
      "'-1'");
  EXPECT_EQ(complaint({{"clock.kind", "interval"}}),
            "robot.yaml:1: expected 'tasks.main.clock.kind' to be accompanied by cost_us: [least, greatest], found "
            "'interval'");
  EXPECT_NE(complaint({{"clock", "interval"}}), "none");
  EXPECT_NE(complaint({{"clock.kind", "interval"}, {"clock.cost_us.0", "5"}}), "none");
  EXPECT_NE(complaint({{"clock.kind", "interval"}, {"clock.cost_us.0", "0"}, {"clock.cost_us.1", "0"}}), "none");
  EXPECT_NE(complaint({{"clock.kind", "fixed"}, {"clock.cost_us.0", "1"}, {"clock.cost_us.1", "2"}}), "none");
  EXPECT_NE(complaint({{"clock.kind", "cpu"}, {"clock.block_cost_ns", "1"}}), "none");
  for (const char* scale : {"x-1", "xx1", "fast", "", "x", "1e7", "nan"})
    EXPECT_NE(
        complaint({{"clock.scale", scale}}).find("robot.yaml:1: expected 'tasks.main.clock.scale' to be a factor"),
        std::string::npos)
        << scale;
  EXPECT_EQ(complaint({{"processor", "gpu"}}),
            "robot.yaml:1: expected 'tasks.main.processor' to be one of this robot's processors, found 'gpu'");
  EXPECT_NE(complaint({{"priority", "high"}}), "none");
}

TEST(HardwareLatency, AReadingIsSoOldAndACommandComesSoLate) {
  ComputingRobot robot({});
  OutputPoster<Number>& command = robot.module.add_poster<Number>("command", *robot.task);
  auto& hardware = robot.names.create_poster<Number>("m.reading", "the bridge");
  PosterLink<Number>& reading = robot.module.read_poster<Number>("reading");
  robot.names.find_poster("m.command")->set_latency(3ms);
  hardware.set_latency(2ms);
  Time read;
  robot.task->set_permanent([&] {
    Number number;
    EXPECT_EQ(reading.read(number), PosterStatus::ok);
    read = now();
    command.write(number);
  });
  const waitpoint::Report report = simulate([&] {
    robot.module.connect();
    hardware.write({7});
    EXPECT_EQ(now(), Time());  // without a wait for the device
    robot.module.start();
    this_thread::sleep_until(Time() + Duration(19ms));
    EXPECT_EQ(read, Time() + Duration(12ms));
    Number number;
    Time date;
    dynamic_cast<Poster<Number>&>(*robot.names.find_poster("m.command")).read(number, &date);
    EXPECT_EQ(date, Time() + Duration(16ms));  // and 1 ms for the codel
    EXPECT_EQ(number.value, 7);
  });
  EXPECT_TRUE(report.passed) << report;
}

}  // namespace
}  // namespace waitpoint::genom
