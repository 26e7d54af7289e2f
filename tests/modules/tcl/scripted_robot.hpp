// SPDX-License-Identifier: BSD-3-Clause
// The frame's robot with scripts in Tcl as clients of its module, which is called "m".
#pragma once

#include <string>
#include <vector>

#include "modules/tcl/module_link.hpp"
#include "tests/modules/genom/scripted_module.hpp"

namespace waitpoint::tcl {

inline const Library& tcl_library() { return library("the test", 0); }

struct Input {
  Bounded<Point, 8> via;
  double speed_m_s = 1;
  Duration patience_ms = std::chrono::milliseconds(20);

  static void fields(auto field) {
    field("via", &Input::via);
    field("speed_m_s", &Input::speed_m_s);
    field("patience_ms", &Input::patience_ms);
  }
};

class ScriptedRobot : public genom::TestRobot {
 public:
  using Act = genom::Running<genom::Number, genom::Number>;

  ScriptedRobot() {
    module.add_control<genom::Number, genom::Number>("Double", [](const genom::Number& in, genom::Number& out) {
      out.value = 2 * in.value;
      return genom::ok;
    });
    module.add_control<Input, Input>("Echo", [](const Input& in, Input& out) {
      out = in;
      return genom::ok;
    });
    // Takes `value` periods of 10 ms; without end for negative ones, and fails for 13.
    module.add_activity<genom::Number, genom::Number>("Count", task_, {.exec = [this](Act& a) {
                                                        if (a.input.value == 13) {
                                                          a.report = module.own_report(107);
                                                          return genom::State::fail;
                                                        }
                                                        return ++a.output.value == a.input.value ? genom::State::ether
                                                                                                 : genom::State::exec;
                                                      }});
    module.add_poster("count", task_, &written_);
  }

  /// In virtual time: the outcome of a script.
  ScriptEnd run(const std::string& script) {
    ScriptEnd outcome;
    genom::TestRobot::run([&] { outcome = run_here(script); });
    return outcome;
  }
  /// The same in a running task.
  ScriptEnd run_here(const std::string& script) {
    ModuleLink link(
        names, "robot", "executive", [this](Time, const std::string& line) { said.push_back(line); }, folders);
    const std::unique_ptr<Interpreter> interpreter = tcl_library().make(link, 1, &threads::now);
    return interpreter->run("script.tcl", script);
  }

  std::vector<std::string> said;
  std::vector<std::string> folders;  ///< of scripts

 private:
  genom::ExecutionTask& task_ = module.add_task("main", {.period_ms = std::chrono::milliseconds(10)});
  genom::Number written_{7};
};

}  // namespace waitpoint::tcl
