// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint fit LOG`: the parameters of a simulated robot like the one that recorded a log.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "modules/genom/module_type.hpp"
#include "tools/command/command_line.hpp"
#include "tools/replay/log_options.hpp"

namespace waitpoint::tools {

struct FitOptions {
  LogOptions source;
  std::string name = "fitted";               ///< of the robot type
  std::optional<std::filesystem::path> out;  ///< none: standard output
  bool json = false;                         ///< what was fitted as JSON to standard output
};

class FitArguments {
 public:
  explicit FitArguments(CommandLine& line);
  bool parsed() const { return command_.parsed(); }
  /// Throws BadInput for invalid values.
  FitOptions options() const;

 private:
  Command command_;
  LogArguments source_;
  std::string name_, out_;
  bool json_ = false;
};

/// Replays the log, fits the errors of its odometry to the corrected trajectory and those of its laser to its scans,
/// and writes the robot type. Returns the exit status. BadInput as of a replay, and for logs that are too short.
int fit(const FitOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
