// SPDX-License-Identifier: BSD-3-Clause
// A file of the decisions of the robots' execution control, as text: "time robot decision". Does not change the run.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "modules/bridge/robot.hpp"
#include "modules/control/decision.hpp"
#include "tools/output/output_file.hpp"

namespace waitpoint::tools {

class DecisionRecorder {
 public:
  explicit DecisionRecorder(const std::filesystem::path& path) : file_(path) {}
  /// Before the run: the robots with rules are recorded from now on.
  void watch(const std::vector<std::unique_ptr<bridge::Robot>>& robots);
  void finish() { file_.commit(); }
  void cut_off(const std::string& reason);

 private:
  struct OfRobot final : control::DecisionWatch {
    OfRobot(OutputFile& to, const std::string& name) : file(to), robot(name) {}
    void on(const control::Decision& decision, const std::string& text) override;

    OutputFile& file;
    std::string robot;
  };

  OutputFile file_;
  std::deque<OfRobot> robots_;
};

}  // namespace waitpoint::tools
