// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint fit LOG`: the parameters of a simulated robot like the one that recorded a log.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "modules/genom/module_type.hpp"
#include "tools/command/options/log_source.hpp"

namespace waitpoint::tools {

struct FitOptions {
  LogOptions source;
  std::string name = "fitted";               ///< of the robot type
  std::optional<std::filesystem::path> out;  ///< none: standard output
  bool json = false;                         ///< what was fitted as JSON to standard output
};

/// The command with its options.
void declare(Command& command, FitOptions& options);

/// Replays the log, fits the errors of its odometry to the corrected trajectory and those of its laser to its scans,
/// and writes the robot type. Returns the exit status. BadInput as of a replay, and for logs that are too short.
int fit(const FitOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
