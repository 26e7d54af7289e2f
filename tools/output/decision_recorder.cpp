// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/decision_recorder.hpp"

#include "modules/control/controller.hpp"

namespace waitpoint::tools {

void DecisionRecorder::watch(const std::vector<std::unique_ptr<bridge::Robot>>& robots) {
  for (const auto& robot : robots)
    if (control::Controller* const controller = robot->controller())
      controller->set_watch(&robots_.emplace_back(file_, robot->name()));
}

void DecisionRecorder::cut_off(const std::string& reason) {
  file_.write("# cut off: " + reason + "\n");
  finish();
}

void DecisionRecorder::OfRobot::on(const control::Decision& decision, const std::string& text) {
  file.write(to_string(decision.date) + " " + robot + " " + text + "\n");
}

}  // namespace waitpoint::tools
