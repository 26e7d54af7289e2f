// SPDX-License-Identifier: BSD-3-Clause
// The controller between a client and a module: what it accepts, rejects, delays and interrupts, and when.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "fibers/sync/simulation.hpp"
#include "modules/control/controller.hpp"
#include "modules/control/parser.hpp"
#include "tests/modules/genom/frame_robot.hpp"

namespace waitpoint::control {
namespace {

using namespace std::chrono_literals;
using genom::Number;
using genom::State;
using this_thread::sleep_for;
using Act = genom::Running<Number, genom::Nothing>;

/// A robot whose module "m" has the activities A and B, which last two periods of 10 ms, or without end for input 0,
/// the control request Set, and the poster "m.level", which Set writes.
class ControlledRobot : public DecisionWatch {
 public:
  explicit ControlledRobot(const std::string& checks, const std::string& settings = "")
      : setup{names, "m", genom::Settings()}, module(setup), task(module.add_task("main", {.period_ms = 10ms})) {
    module.add_poster<Number>("level", task, &level);
    for (const std::size_t i : {0, 1}) {
      const auto go_on = [this, i](Act& act) {
        running[i] = act.input.value == 0 || running[i] == 0;
        were_together = were_together || (running[0] > 0 && running[1] > 0);
        return running[i] > 0 ? State::exec : State::ether;
      };
      const auto end = [this, i](Act&) {
        running[i] = 0;
        return State::ether;
      };
      module.add_activity<Number>(i == 0 ? "A" : "B", task, {.exec = go_on, .inter = end});
    }
    module.add_control<Number>("Set", [this](const Number& number, genom::Nothing&) {
      level = number;
      return genom::ok;
    });
    if (!checks.empty())
      controller = std::make_unique<Controller>(parse_rules(settings + "context c {" + checks + "}", "r.ctl"), names,
                                                genom::TaskComputing());
    if (controller) controller->set_watch(this);
  }

  void on(const Decision& decision, const std::string& text) override {
    log.push_back(text);
    dates.push_back(decision.date);
  }

  waitpoint::Report run(const std::function<void()>& drive, SimulationOptions options = {}) {
    waitpoint::Report report = simulate(
        [&] {
          if (controller) controller->start();
          module.connect();
          module.start();
          drive();
          EXPECT_TRUE(other.end_module("m"));
          module.join();
          if (controller) controller->stop();
        },
        std::move(options));
    EXPECT_TRUE(report.passed) << report;
    return report;
  }

  std::uint32_t send(const std::string& request, std::int32_t value = 0) {
    return client.send("m", request, Number{value}).value_or(0);
  }
  /// The next reply as text.
  std::string next(Duration timeout = 1s) {
    const std::optional<genom::Reply> reply = client.receive(timeout);
    if (!reply) return "none";
    return std::to_string(reply->send_id) + (reply->final ? " final " : " began ") + genom::name(reply->report);
  }

  Number level;
  int running[2] = {};  // of A and B
  bool were_together = false;
  genom::NameSpace names;
  genom::ModuleSetup setup;
  genom::ScriptedModule module;
  genom::ExecutionTask& task;
  std::unique_ptr<Controller> controller;
  genom::Client client{names, "client"}, other{names, "other client"};
  std::vector<std::string> log;
  std::vector<Time> dates;
};

TEST(Controller, PassesRequestsAndRepliesOn) {
  ControlledRobot robot("check k { exclusive: m.A, m.B; }");
  robot.run([&] {
    robot.send("A", 1);
    EXPECT_EQ(robot.next(), "1 began ok");
    EXPECT_EQ(robot.next(), "1 final ok");
    robot.send("Set", 3);
    EXPECT_EQ(robot.next(), "2 final ok");
    EXPECT_EQ(robot.log, (std::vector<std::string>{"m.A #1 accepted", "m.Set #2 accepted"}));
  });
}

TEST(Controller, RejectsWithAStandardReport) {
  ControlledRobot robot("check k { exclusive: m.A, m.B; }");
  robot.run([&] {
    robot.send("A");
    EXPECT_EQ(robot.next(), "1 began ok");
    robot.send("B");
    const std::optional<genom::Reply> reply = robot.client.receive(1s);
    ASSERT_TRUE(reply && reply->final);
    EXPECT_EQ(reply->report,
              genom::make_report(genom::ScriptedModule::number, genom::StandardReport::rejected_by_control));
    EXPECT_EQ(robot.log.back(), "m.B #2 rejected: c.k");
  });
}

// The second request is judged by the first one's acceptance, before the module has begun it.
TEST(Controller, RejectsTheSecondOfTwoRequestsAtOneInstant) {
  ControlledRobot robot("check k { exclusive: m.A, m.B; }");
  robot.run([&] {
    robot.send("A");
    robot.send("B");
    sleep_for(50ms);
    EXPECT_EQ(robot.log, (std::vector<std::string>{"m.A #1 accepted", "m.B #2 rejected: c.k"}));
  });
}

TEST(Controller, DelaysUntilTheStateAllowsIt) {
  ControlledRobot robot("check k { exclusive: m.A, m.B; delay: m.B for 1 s; }");
  robot.run([&] {
    robot.send("A");
    EXPECT_EQ(robot.next(), "1 began ok");
    robot.send("B", 1);
    EXPECT_EQ(robot.next(200ms), "none");
    robot.client.send("m", "Abort", genom::AbortInput{0});
    std::vector<std::string> replies(4);
    for (std::string& reply : replies) reply = robot.next();
    EXPECT_EQ(replies,
              (std::vector<std::string>{"3 final ok", "1 final ACTIVITY_INTERRUPTED", "2 began ok", "2 final ok"}));
  });
}

TEST(Controller, RejectsADelayedRequestWhenItsTimeIsOver) {
  ControlledRobot robot("check k { exclusive: m.A, m.B; delay: m.B for 300 ms; }");
  robot.run([&] {
    robot.send("A");
    EXPECT_EQ(robot.next(), "1 began ok");
    const Time sent = now();
    robot.send("B");
    EXPECT_EQ(robot.next(), "2 final REJECTED_BY_CONTROL");
    EXPECT_EQ(now() - sent, Duration(300ms));
  });
}

TEST(Controller, DropsADelayedRequestThatItsClientWithdraws) {
  ControlledRobot robot("check k { exclusive: m.A, m.B; delay: m.B for 300 ms; }");
  robot.run([&] {
    robot.send("A");
    EXPECT_EQ(robot.next(), "1 began ok");
    const std::uint32_t number = robot.send("B");
    robot.other.withdraw(number);  // another client's number
    EXPECT_EQ(robot.next(100ms), "none");
    robot.client.withdraw(number);
    EXPECT_EQ(robot.next(10ms), "2 final ACTIVITY_INTERRUPTED");
    EXPECT_EQ(robot.log.back(), "m.B #2 withdrawn");
    robot.client.withdraw(1);  // has passed
    robot.client.send("m", "Abort", genom::AbortInput{0});
    EXPECT_EQ(robot.next(), "3 final ok");
    EXPECT_EQ(robot.next(), "1 final ACTIVITY_INTERRUPTED");
    EXPECT_EQ(robot.next(400ms), "none");
    EXPECT_EQ(robot.running[1], 0);
  });
}

TEST(Controller, InterruptsTheActivityThatGivesWay) {
  ControlledRobot robot("check k { exclusive: m.A, m.B; interrupt: m.A within 1 s; }");
  robot.run([&] {
    robot.send("A");
    EXPECT_EQ(robot.next(), "1 began ok");
    robot.send("B", 1);
    EXPECT_EQ(robot.next(), "1 final ACTIVITY_INTERRUPTED");
    EXPECT_EQ(robot.next(), "2 began ok");
    EXPECT_EQ(robot.next(), "2 final ok");
    robot.send("B");
    EXPECT_EQ(robot.next(), "3 began ok");
    robot.send("A");
    EXPECT_EQ(robot.next(), "4 final REJECTED_BY_CONTROL");  // it is A that gives way
    EXPECT_EQ(robot.log[1], "m.A #1 interrupted: c.k");
    EXPECT_EQ(robot.log[2], "m.B #2 delayed: c.k");
  });
}

// The controller's step is due before the module takes the letters that fill its mailbox.
TEST(Controller, InterruptsAnActivityOfAModuleWhoseMailboxWasFull) {
  ControlledRobot robot("check k { exclusive: m.A, m.B; interrupt: m.A within 1 s; }");
  robot.run([&] {
    robot.send("A");
    EXPECT_EQ(robot.next(), "1 began ok");
    robot.send("B", 1);
    genom::Letter letter;
    letter.request = robot.module.find_request("Set")->number;
    letter.payload = genom::Payload(Number{1});
    while (robot.module.mailbox().post(letter)) {
    }
    EXPECT_EQ(robot.next(), "1 final ACTIVITY_INTERRUPTED");
    EXPECT_EQ(robot.next(), "2 began ok");
  });
}

TEST(Controller, InterruptsWhatAPosterForbids) {
  ControlledRobot robot("check k { fail: running(m.A) && m.level.value > 5; }", "period 20 ms;");
  robot.run([&] {
    robot.send("A");
    EXPECT_EQ(robot.next(), "1 began ok");
    robot.send("B");
    EXPECT_EQ(robot.next(), "2 began ok");
    robot.other.call("m", "Set", Number{6});
    EXPECT_EQ(robot.next(50ms), "1 final ACTIVITY_INTERRUPTED");
    EXPECT_EQ(robot.next(100ms), "none");  // B runs on
    robot.send("A");
    EXPECT_EQ(robot.next(), "3 final REJECTED_BY_CONTROL");
    robot.other.call("m", "Set", Number{5});
    sleep_for(20ms);
    robot.send("A");
    EXPECT_EQ(robot.next(), "4 began ok");
  });
}

TEST(Controller, InterruptsAfterTheGreatestDuration) {
  ControlledRobot robot("check k { fail: duration(m.A) > 250 ms; }");
  robot.run([&] {
    robot.send("A");
    EXPECT_EQ(robot.next(), "1 began ok");
    EXPECT_EQ(robot.next(), "1 final ACTIVITY_INTERRUPTED");
    EXPECT_EQ(robot.dates.back() - robot.dates.front(), Duration(250ms + 1ns));
    EXPECT_EQ(robot.log.back(), "m.A #1 interrupted: c.k");
  });
}

TEST(Controller, InterruptsAnActivityWhosePreconditionEnds) {
  ControlledRobot robot("check k { fail: running(m.A) && !running(m.B); }");
  robot.run([&] {
    robot.send("A");
    EXPECT_EQ(robot.next(), "1 final REJECTED_BY_CONTROL");
    robot.send("B");
    EXPECT_EQ(robot.next(), "2 began ok");
    robot.send("A");
    EXPECT_EQ(robot.next(), "3 began ok");
    robot.client.send("m", "Abort", genom::AbortInput{0});
    EXPECT_EQ(robot.next(), "4 final ok");
    EXPECT_EQ(robot.next(), "2 final ACTIVITY_INTERRUPTED");
    EXPECT_EQ(robot.next(), "3 final ACTIVITY_INTERRUPTED");
  });
}

TEST(Controller, KnowsThePast) {
  ControlledRobot robot("check k { fail: request(m.A) && !past(succeeded(m.Set(value >= 2))); }");
  robot.run([&] {
    robot.send("A", 1);
    EXPECT_EQ(robot.next(), "1 final REJECTED_BY_CONTROL");
    robot.client.call("m", "Set", Number{1});
    robot.send("A", 1);
    EXPECT_EQ(robot.next(), "3 final REJECTED_BY_CONTROL");
    robot.client.call("m", "Set", Number{2});
    robot.send("A", 1);
    EXPECT_EQ(robot.next(), "5 began ok");
  });
}

TEST(Controller, JudgesInputs) {
  ControlledRobot robot("check k { fail: request(m.Set(value > 3)); }");
  robot.run([&] {
    EXPECT_EQ(robot.client.call("m", "Set", Number{3}).report, genom::ok);
    EXPECT_TRUE(is(robot.client.call("m", "Set", Number{4}).report, genom::StandardReport::rejected_by_control));
    EXPECT_EQ(robot.level.value, 3);
  });
}

// What no activity brings about is told once.
TEST(Controller, TellsOfAStateThatItCannotLeave) {
  ControlledRobot robot("check k { fail: m.level.value > 5; interrupt: m.A within 1 s; }", "period 20 ms;");
  robot.run([&] {
    robot.client.call("m", "Set", Number{6});
    sleep_for(200ms);
    EXPECT_EQ(robot.log, (std::vector<std::string>{"m.Set #1 accepted", "unresolved: c.k"}));
  });
}

TEST(Controller, AStepCostsItsDeclaredTime) {
  ControlledRobot robot("check k { exclusive: m.A, m.B; }", "cost 3 ms;");
  robot.run([&] {
    const Time sent = now();
    robot.client.call("m", "Set", Number{1});
    EXPECT_EQ(now() - sent, Duration(6ms));  // the request's step and the reply's
    EXPECT_EQ(robot.dates.front() - sent, Duration(3ms));
  });
}

/// True if A and B ran together in one of many orders of two clients that send them, and abort them, at random.
bool run_together(const std::string& checks) {
  bool did = false;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    ControlledRobot robot(checks);
    robot.run(
        [&] {
          const auto client = [&](genom::Client& own, const char* request, const char* name) {
            const RandomStream random(seed, "test", name);
            for (std::uint64_t i = 0; i < 20; ++i) {
              own.send("m", request, Number{static_cast<std::int32_t>(random.uniform(2 * i) * 2)});
              sleep_for(Duration::from_seconds(0.001 * static_cast<int>(random.uniform(2 * i + 1) * 40)));
              if (i % 3 == 2) own.send("m", "Abort", genom::AbortInput{static_cast<std::int32_t>(i % 5)});
              while (own.receive(Duration())) {
              }
            }
          };
          thread second([&] { client(robot.other, "B", "second"); });
          client(robot.client, "A", "first");
          second.join();
        },
        {kernel::Order::seeded, seed, ""});
    did = did || robot.were_together;
  }
  return did;
}

TEST(Controller, KeepsActivitiesApartInEveryOrder) {
  EXPECT_TRUE(run_together(""));
  EXPECT_FALSE(run_together("check k { exclusive: m.A, m.B; }"));
  EXPECT_FALSE(run_together("check k { exclusive: m.A, m.B; delay: m.B for 50 ms; }"));
  EXPECT_FALSE(run_together("check k { exclusive: m.A, m.B; interrupt: m.A within 50 ms; }"));
}

TEST(Controller, DecidesTheSameInEachRun) {
  const auto digest = [](const std::string& checks, std::uint64_t seed) {
    ControlledRobot robot(checks);
    return robot
        .run(
            [&] {
              robot.send("A", 1);
              robot.send("B");
              sleep_for(100ms);
            },
            {kernel::Order::seeded, seed, ""})
        .digest;
  };
  const std::string exclusive = "check k { exclusive: m.A, m.B; }";
  EXPECT_EQ(digest(exclusive, 7), digest(exclusive, 7));
  // The same letters, with another check in the log.
  EXPECT_NE(digest(exclusive, 7), digest("check j { exclusive: m.A, m.Set; }" + exclusive, 7));
}

std::string refusal_of(const std::string& checks) {
  try {
    ControlledRobot robot(checks);
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

TEST(Controller, RefusesNamesThatTheRobotDoesNotHave) {
  EXPECT_EQ(refusal_of("check k { fail: running(n.A); }"), "r.ctl:1: column 36: there is no module 'n'");
  EXPECT_EQ(refusal_of("check k { fail: running(m.Sett); }"),
            "r.ctl:1: column 36: module 'm' has no request 'Sett', did you mean 'Set'?");
  EXPECT_EQ(refusal_of("check k { fail: running(m.A(x > 1)); }"),
            "r.ctl:1: column 40: the input of m.A has no number 'x'");
  EXPECT_EQ(refusal_of("check k { fail: running(m.A) && m.levl.value > 1; }"),
            "r.ctl:1: column 44: there is no poster 'm.levl', did you mean 'm.level'?");
  EXPECT_EQ(refusal_of("check k { fail: running(m.A) && m.level.height > 1; }"),
            "r.ctl:1: column 44: poster 'm.level' has no number 'height'");
  EXPECT_EQ(refusal_of("check k { fail: running(m.Abort); }"),
            "r.ctl:1: column 36: expected a request other than Abort, which is always accepted");
  EXPECT_EQ(refusal_of("check k { exclusive: m.A, m.Set; interrupt: m.Set within 1 s; }"),
            "r.ctl:1: column 56: expected an activity to interrupt: m.Set is a control request");
  EXPECT_EQ(refusal_of("check k { fail: running(m.A); }"),
            "r.ctl:1: column 18: check c.k: no m.A can ever be accepted");
}

}  // namespace
}  // namespace waitpoint::control
