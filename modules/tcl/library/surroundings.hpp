// SPDX-License-Identifier: BSD-3-Clause
// An interpreter's view of the machine: virtual time in place of the clock, this project's mathematical functions
// in place of the C library's, rand() from the run's seed, files of the script's folders; no environment, processes,
// sockets or events of files.
#pragma once

#include <tcl.h>

#include <cstdint>
#include "core/time.hpp"
#include "modules/tcl/interpreter.hpp"

namespace waitpoint::tcl {

/// Before the first interpreter: a notifier without events and threads, and a clock that calls `now`.
void set_up_process(Time (*now)());
/// In a new interpreter. The link must outlive it.
void set_up_interpreter(Tcl_Interp* tcl, std::uint32_t seed, RobotLink& link);
/// The seed of rand(), from now on.
void set_seed(Tcl_Interp* tcl, std::uint32_t seed);

}  // namespace waitpoint::tcl
