// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint compare LOG OTHER`: is the log of a simulated robot like that of a real one? Samples of both are compared
// by the test of Kolmogorov and Smirnov.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "modules/genom/module_type.hpp"
#include "tools/command/options/log_source.hpp"

namespace waitpoint::tools {

struct CompareOptions {
  LogOptions first, second;
  std::optional<std::filesystem::path> picture, summary;
  bool json = false;  ///< the comparison as JSON to standard output
};

/// The command with its options.
void declare(Command& command, CompareOptions& options);

/// Prints the table, and writes the files; returns the exit status. BadInput as of a replay.
int compare(const CompareOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
