// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/ranks/dividable.hpp"

#include <vector>

#include "core/setting.hpp"

namespace waitpoint::run {
namespace {

void check_clocks(const std::vector<Setting>& settings) {
  for (const Setting& setting : settings) {
    const bool is_kind = setting.key == "clock" || setting.key.ends_with(".clock") || setting.key == "clock.kind" ||
                         setting.key.ends_with(".clock.kind");
    if (is_kind && (setting.text == "cpu" || setting.text == "proportional"))
      throw setting.bad(
          "expected a clock that is not measured, as there are several ranks: fixed, interval or counted; "
          "found '" +
          setting.text + "'");
  }
}

}  // namespace

void check_dividable(const scenario::Scenario& scenario) {
  if (scenario.log) throw scenario.log->written.bad("expected a world, as there are several ranks, found a log");
  for (const scenario::RobotScenario& robot : scenario.robots) {
    check_clocks(robot.executive);
    for (const scenario::ModuleScenario& module : robot.modules)
      if (module.enabled) check_clocks(module.settings);
    for (const scenario::ProgramScenario& program : robot.programs)
      if (program.hosting == Hosting::in_process)
        throw program.written.bad(
            "expected no program that is a shared object, as there are several ranks: use `command`");
  }
}

}  // namespace waitpoint::run
