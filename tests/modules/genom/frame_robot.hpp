// SPDX-License-Identifier: BSD-3-Clause
// A module with the test's requests, codels and posters, and a robot with only that module and two clients, on threads
// of either kind.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "modules/genom/client.hpp"
#include "modules/genom/module.hpp"

namespace waitpoint::genom {

struct Number {
  std::int32_t value = 0;
  static void fields(auto field) { field("value", &Number::value); }
};

class ScriptedModule : public Module {
 public:
  static constexpr std::uint16_t number = 42;

  explicit ScriptedModule(ModuleSetup& setup) : Module(setup, number) {}
  using Module::add_activity;
  using Module::add_control;
  using Module::add_init;
  using Module::add_poster;
  using Module::add_task;
  using Module::own_report;
  using Module::read_poster;
  using Module::set_interrupt_end;
};

/// The robot of one test: its module is called "m".
class FrameRobot {
 public:
  explicit FrameRobot(std::vector<Setting> settings = {})
      : setup{names, "m", Settings(std::move(settings))}, module(setup) {}

  /// From a task: starts the module, calls `drive`, and ends the module in any state.
  void run(const std::function<void()>& drive) {
    module.connect();
    module.start();
    drive();
    ASSERT_TRUE(other.end_module("m"));
    module.join();
  }

  /// Ends the running activity `number`, or as AbortInput's codes specify; returns the report.
  Report abort(std::int32_t number) { return other.call("m", "Abort", AbortInput{number}).report; }

  /// The next reply, which must come within `timeout`.
  Reply next(Duration timeout = std::chrono::minutes(1)) {
    const std::optional<Reply> reply = client.receive(timeout);
    EXPECT_TRUE(reply.has_value());
    return reply.value_or(Reply());
  }
  /// Sends a request and returns the first reply: intermediate, or a rejection.
  Reply begin(const std::string& request, std::int32_t value = 0) {
    const std::optional<std::uint32_t> id = client.send("m", request, Number{value});
    EXPECT_TRUE(id.has_value());
    Reply reply = next();
    EXPECT_EQ(reply.send_id, id);
    return reply;
  }

  NameSpace names;
  ModuleSetup setup;
  ScriptedModule module;
  Client client{names, "client"};
  Client other{names, "other client"};
};

}  // namespace waitpoint::genom
