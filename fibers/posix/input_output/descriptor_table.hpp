// SPDX-License-Identifier: BSD-3-Clause
// The table of a program's descriptors: the calls that make, copy and close them.
#pragma once

#include "fibers/posix/program/program_state.hpp"

namespace waitpoint::posix {

/// Closes what a program has left open that has ended before its process does: who is at the other end waits no longer.
void close_descriptors_of(const Program& program);

}  // namespace waitpoint::posix
