// SPDX-License-Identifier: BSD-3-Clause
// The table of a program's descriptors: the calls that make, copy and close them.
#pragma once

#include "fibers/posix/program/program_state.hpp"

namespace waitpoint::posix {

/// Closes the descriptors left open by a program that ends before its process: the other ends must not wait any longer.
void close_descriptors_of(const Program& program);

}  // namespace waitpoint::posix
