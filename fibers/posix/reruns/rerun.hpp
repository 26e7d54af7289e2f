// SPDX-License-Identifier: BSD-3-Clause
// Further runs of a program in one process: after each it is put back to the state before main(), in place.
//
// That is possible while the run has done nothing but computing: its threads are fibers, so its state is its memory,
// and what its system calls have changed. A process that has made another one, or a call that cannot be undone, ends as
// usual. The explorer then has the next run made by a fork.
#pragma once

namespace waitpoint::posix {

/// In the server, before the first fork, and in a run at accesses that repeats one of its runs: what each run reserves
/// anew otherwise.
void prepare_reruns();
/// In a run, if further ones are asked for: returns again at the beginning of each.
void begin_reruns();
/// At the end of the run with this exit status: does not return if further runs can be made in this process.
void rerun_instead_of_ending(int status);

}  // namespace waitpoint::posix
