// SPDX-License-Identifier: BSD-3-Clause
// The options of commands that replay a log: which log, what to take from it, and which modules with which parameters.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "modules/logs/sensor_log.hpp"
#include "tools/command/command_line.hpp"

namespace waitpoint::tools {

struct LogOptions {
  std::filesystem::path log;
  logs::LogChoice choice;
  std::optional<std::filesystem::path> scenario;  ///< whose first robot has the modules; none: the default ones
  std::vector<std::string> modules;               ///< by name; empty: those that localise
  std::vector<std::string> assignments;           ///< of --set, in their order: "segloc.points.key_travel_m=0.2"
};

class LogArguments {
 public:
  /// Adds the options, which are stored here.
  void add(Command& command);
  /// Throws BadInput for invalid values.
  LogOptions options() const;
  const std::string& log() const { return log_; }
  /// Empty without one.
  const std::string& scenario() const { return scenario_; }

 private:
  std::string log_, scan_, odometry_, robot_, scenario_, modules_;
  std::vector<std::string> assignments_;
};

}  // namespace waitpoint::tools
