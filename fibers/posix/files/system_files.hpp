// SPDX-License-Identifier: BSD-3-Clause
// Files of /proc whose contents do not follow from the seed: the program reads texts in their place, which are made
// when it opens them. What they tell of processes is the simulation's; of the machine, see machine.hpp.
#pragma once

namespace waitpoint::posix {

inline constexpr int not_generated = -2;

/// Opens the text in place of the file of this path in /proc; as open(). `not_generated` for files that are the
/// system's.
int open_generated(const char* path, int flags);
/// With --strict, ends the run if the contents of this file differ from run to run.
void note_use_of(const char* path);

}  // namespace waitpoint::posix
