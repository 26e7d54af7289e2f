// SPDX-License-Identifier: BSD-3-Clause
// membarrier(): a fence in all threads of the process. Algorithms with a cheap and a dear side use it in place of
// fences.
#pragma once

namespace waitpoint::posix {

/// As the system call, of which the C library has no function.
long membarrier(int command, unsigned flags, int processor);

}  // namespace waitpoint::posix
