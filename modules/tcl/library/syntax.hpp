// SPDX-License-Identifier: BSD-3-Clause
// The text of a script before it is executed: its first syntax error, its procedures, and calls of these.
//
// Tcl knows the syntax of a command only when it is executed: the braced word behind `while` is text until then. The
// bodies of Tcl's control structures and procedures are therefore parsed as commands, too.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "modules/tcl/interpreter.hpp"

namespace waitpoint::tcl {

using ProceduresByName = std::map<std::string, Procedure>;

/// The first syntax error; if `procedures` is not null, it gets the procedures.
std::optional<SyntaxError> check_syntax(const std::string& script, ProceduresByName* procedures = nullptr);

/// The error of a call of a procedure with the words of `arguments`: its syntax, or their number; empty: none.
std::string check_call(const Procedure& procedure, const std::string& arguments);

/// The line of an error in a script by Tcl's trace of it (errorInfo), whose outermost command is at `line`.
int line_of_error(const std::string& trace, int line, const ProceduresByName& procedures);

}  // namespace waitpoint::tcl
