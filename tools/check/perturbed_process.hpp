// SPDX-License-Identifier: BSD-3-Clause
// This program once more, in a process where all that a run must not depend on is different.
//
//   before its main()  addresses laid out at random; another environment in another order, locale and time zone; clocks
//                      that are off, directories from their last entry to the first, a heap in an order of its own and
//                      filled: surroundings/
//   after it           the stacks of main and of the run's tasks: perturbed_memory.hpp
//
// What it shares with this process: the command line, the current folder, the files, and $PATH, $HOME, $WAITPOINT_...
#pragma once

#include <optional>
#include <string>

namespace waitpoint::tools {

/// What a perturbed process is given: descriptors of open files.
struct PerturbedFiles {
  int log = -1;        ///< of events: event_log.hpp
  int durations = -1;  ///< a record of durations to replay, as text; -1: none
};

/// How it ended.
struct ProcessEnd {
  std::optional<int> status;  ///< of its own exit
  std::string cut_off;        ///< else: "it was stopped by ...", in a few words
};

/// BadInput where no such process can be had, before anything is run.
void check_perturbed_process_possible();

/// Starts one with the same command line and waits until it ends, or has taken `limit_s`: then, or if this process is
/// interrupted, it is stopped. Throws BadInput if no process can be had.
ProcessEnd run_perturbed_process(const PerturbedFiles& files, double limit_s, bool (*interrupted)());

/// In such a process, what it was given; else nothing. BadInput if the variable is not what such a process has.
std::optional<PerturbedFiles> files_of_perturbed_process();

}  // namespace waitpoint::tools
