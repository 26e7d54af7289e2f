// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint scenarios`: the shipped scenarios, each with one line.
#pragma once

#include <filesystem>
#include <string>

#include "tools/command/command.hpp"

namespace waitpoint::tools {

struct ScenariosOptions {
  bool json = false;  ///< the result as JSON to standard output
};

/// The command with its options.
void declare(Command& command, ScenariosOptions& options);

/// Prints name and description of each; returns the exit status.
int list_scenarios(const ScenariosOptions& options);

/// The file's `description`, or else the first sentence of its first comment.
std::string description_of(const std::filesystem::path& scenario);

}  // namespace waitpoint::tools
