// SPDX-License-Identifier: BSD-3-Clause
// Spellings of the last version: they work, each with a line on standard error that names today's.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/command/command.hpp"

namespace waitpoint::tools {

/// Replaces the command, the first word that is no option. `former` has pairs of a former name and today's.
void replace_former_command(std::vector<std::string>& words,
                            const std::vector<std::pair<std::string, std::string>>& former);

/// Replaces options and values of options among the command's words, up to the program behind "--". BadInput for a
/// removed option.
void replace_former_spellings(std::vector<std::string>& words, const Command& command);

}  // namespace waitpoint::tools
