// SPDX-License-Identifier: BSD-3-Clause
// Calls that the layer passes on to the C library, as events with footprints.
#pragma once

namespace waitpoint::posix {

/// At the start of a process: later, each look-up would take the error that the program reads by dlerror().
void look_up_passed_calls();

}  // namespace waitpoint::posix
