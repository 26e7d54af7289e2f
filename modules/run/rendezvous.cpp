// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/rendezvous.hpp"

#include <algorithm>
#include <map>

#include "modules/plan/plan_reader.hpp"

namespace waitpoint::run {

void check_rendezvous(const scenario::Scenario& scenario) {
  std::map<std::string, plan::TemporalPlan> plans;
  for (const scenario::RobotScenario& robot : scenario.robots)
    if (robot.plan != nullptr) plans.emplace(robot.name, plan::read_plan(*robot.plan));
  for (const auto& [name, plan] : plans) {
    for (const plan::Action& action : plan.actions) {
      if (action.rendezvous.empty()) continue;
      if (!scenario.medium)
        throw action.written.bad("expected a medium in the scenario for the rendezvous '" + action.name + "'");
      const auto other = plans.find(action.rendezvous);
      const bool is_mutual =
          other != plans.end() && std::any_of(other->second.actions.begin(), other->second.actions.end(),
                                              [&name = name, &action](const plan::Action& each) {
                                                return each.name == action.name && each.rendezvous == name;
                                              });
      if (!is_mutual)
        throw action.written.bad("expected a robot '" + action.rendezvous + "' with a rendezvous '" + action.name +
                                 "' with '" + name + "' in its plan");
    }
  }
}

}  // namespace waitpoint::run
