// SPDX-License-Identifier: BSD-3-Clause
// Scripts with which shells complete the command line of a program with commands: commands, options, words and files
// that an option takes, scenarios here and installed ones, and a program behind "--".
#pragma once

#include <string>

#include "tools/command/described_command.hpp"

namespace waitpoint::tools {

/// The script for `shell`: bash, zsh or fish. Throws BadInput, one line, for another.
std::string completion(const DescribedProgram& program, const std::string& shell);

/// One for each shell; completion() chooses.
std::string bash_completion(const DescribedProgram& program);
std::string zsh_completion(const DescribedProgram& program);
std::string fish_completion(const DescribedProgram& program);

}  // namespace waitpoint::tools
