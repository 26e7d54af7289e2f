// SPDX-License-Identifier: BSD-3-Clause
// The place of the library for scripts in Tcl.
#pragma once

namespace waitpoint::tools {

/// Tells it to modules/tcl. Where a script needs it, its absence is an error of the scenario.
void find_tcl();

}  // namespace waitpoint::tools
