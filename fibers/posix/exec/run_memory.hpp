// SPDX-License-Identifier: BSD-3-Clause
// The memory of the run, as a process of it finds it: the record and, behind it, the family's memory.
#pragma once

namespace waitpoint::posix {

/// Maps the run's file, which the variable of the environment names: by the number of a descriptor, for the first
/// process; by a process, its descriptor and an entry of the family, for one that executes another program. Returns the
/// index of the entry, or -1. The process has a record of its own unless it is the first.
int map_run(const char* name);
/// Maps the file as the first process does, in place of an earlier one, and closes the descriptor.
void map_record(int descriptor);
/// Before a run on a record that was used before: by a debugger that runs the program again, or by the first process
/// when it executes another program.
void begin_anew();

}  // namespace waitpoint::posix
