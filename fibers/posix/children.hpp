// SPDX-License-Identifier: BSD-3-Clause
// Processes that the program makes.
#pragma once

namespace waitpoint::posix {

struct Thread;

/// Before main(): whoever forks within the C library too leaves a child that is a simulation of its own.
void register_fork();
/// In a child: the thread that called is its first, and the others' numbers follow its own.
void begin_again_as_first(Thread& thread);

}  // namespace waitpoint::posix
