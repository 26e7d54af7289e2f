// SPDX-License-Identifier: BSD-3-Clause
// What --help prints: an example, the usage, and the options in sections.
#pragma once

#include <string>
#include <vector>

#include "tools/command/program.hpp"

namespace waitpoint::tools {

/// Rare options are named alone in `common`: its texts have at most 45 lines.
enum class Extent { common, all };

std::string program_help(const DeclaredProgram& program);
std::string command_help(const DeclaredProgram& program, const Command& command, Extent extent);

/// What follows the program and the command in its command lines: "[OPTIONS] SCENARIO".
std::vector<std::string> usages_of(const Command& command);

/// Those of every command: --help, -h for short, and --help-all.
const std::vector<Option>& help_options();

/// The options by their sections, in the order of these.
std::vector<std::vector<const Option*>> sections_of(const Command& command);

}  // namespace waitpoint::tools
