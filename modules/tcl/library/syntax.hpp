// SPDX-License-Identifier: BSD-3-Clause
// The text of a script before it is executed: its first syntax error, and the lines of its procedures.
//
// Tcl knows the syntax of a command only when it is executed: the braced word behind `while` is text until then. The
// bodies of Tcl's control structures and procedures are therefore parsed as commands, too.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "modules/tcl/interpreter.hpp"

namespace waitpoint::tcl {

/// The first syntax error; if `procedures` is not null, it gets the line of each procedure's body.
std::optional<SyntaxError> check_syntax(const std::string& script, std::map<std::string, int>* procedures = nullptr);

/// The line of an error in a script by Tcl's trace of it (errorInfo), whose outermost command is at `line`.
int line_of_error(const std::string& trace, int line, const std::map<std::string, int>& procedures);

}  // namespace waitpoint::tcl
