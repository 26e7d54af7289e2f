// SPDX-License-Identifier: BSD-3-Clause
// Man pages of a program with commands, from the descriptions that --help shows.
#pragma once

#include <string>

#include "tools/command/program.hpp"

namespace waitpoint::tools {

/// Adds the command that prints pages; its argument, the command of the page, goes to `page`.
void add_manual(DeclaredProgram& program, std::string& page);

/// The page PROGRAM(1), or PROGRAM-COMMAND(1), in roff with the macros of man(7). Throws BadInput, one program, for an
/// unknown command. `command` is empty for the program's own page.
std::string manual_page(const DeclaredProgram& program, const std::string& command);

}  // namespace waitpoint::tools
