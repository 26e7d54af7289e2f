// SPDX-License-Identifier: BSD-3-Clause
// Scripts with which shells complete the command line of a program with commands: commands, options, words and files
// that an option takes, scenarios here and installed ones, and a program behind "--".
#pragma once

#include <string>

#include "tools/command/program.hpp"

namespace waitpoint::tools {

/// The script for `shell`: bash or zsh, else fish.
std::string completion(const DeclaredProgram& program, const std::string& shell);

/// One for each shell; completion() chooses.
std::string bash_completion(const DeclaredProgram& program);
std::string zsh_completion(const DeclaredProgram& program);
std::string fish_completion(const DeclaredProgram& program);

}  // namespace waitpoint::tools
