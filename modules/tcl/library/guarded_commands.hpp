// SPDX-License-Identifier: BSD-3-Clause
// Makes an interpreter safe in Tcl's sense: commands that reach the machine are hidden. Those of files are then given
// back, for the files that a script may name; the original of such a command has no name by which a script could call
// it.
#pragma once

#include <tcl.h>

#include "modules/tcl/interpreter.hpp"

namespace waitpoint::tcl {

/// In a new interpreter, after Tcl_Init(). The link must outlive it.
void guard_commands(Tcl_Interp* tcl, RobotLink& link);

}  // namespace waitpoint::tcl
