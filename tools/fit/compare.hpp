// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint compare LOG OTHER`: is the log of a simulated robot like that of a real one? Samples of both are compared
// by the test of Kolmogorov and Smirnov.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "modules/genom/module_type.hpp"
#include "tools/command/command_line.hpp"
#include "tools/replay/log_options.hpp"

namespace waitpoint::tools {

struct CompareOptions {
  LogOptions first, second;
  std::optional<std::filesystem::path> picture, summary;
  bool json = false;  ///< the comparison as JSON to standard output
};

class CompareArguments {
 public:
  explicit CompareArguments(CommandLine& line);
  bool parsed() const { return command_.parsed(); }
  /// Throws BadInput for invalid values.
  CompareOptions options() const;

 private:
  Command command_;
  LogArguments source_;
  std::string other_, other_scan_, other_odometry_, other_robot_, picture_, summary_;
  bool json_ = false;
};

/// Prints the table, and writes the files; returns the exit status. BadInput as of a replay.
int compare(const CompareOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
