// SPDX-License-Identifier: BSD-3-Clause
// Tcl's commands that would show a script the machine: some are deleted, others refuse a part of their arguments. The
// original of a command that is guarded has no name by which a script could call it.
#pragma once

#include <tcl.h>

namespace waitpoint::tcl {

/// In a new interpreter, after Tcl_Init().
void guard_commands(Tcl_Interp* tcl);

}  // namespace waitpoint::tcl
