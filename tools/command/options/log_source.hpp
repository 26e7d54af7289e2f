// SPDX-License-Identifier: BSD-3-Clause
// A log of a real robot's sensors: which one, what to take from it, and which modules with which parameters get it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "modules/logs/sensor_log.hpp"
#include "tools/command/command.hpp"

namespace waitpoint::tools {

struct LogOptions {
  std::filesystem::path log;
  logs::LogChoice choice;
  std::optional<std::filesystem::path> scenario;  ///< whose first robot has the modules; none: the default ones
  std::vector<std::string> modules;               ///< by name; empty: those that localise
  std::vector<std::string> assignments;           ///< of --set, in their order: "segloc.points.key_travel_m=0.2"
};

/// The argument LOG, and the options.
void declare_log(Command& command, LogOptions& options);
/// The argument OTHER, with options for what to take from it: a second log.
void declare_other_log(Command& command, LogOptions& options);

}  // namespace waitpoint::tools
