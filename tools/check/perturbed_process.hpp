// SPDX-License-Identifier: BSD-3-Clause
// This program again, in a process that differs in everything that a run must not depend on.
//
//   before its main()  randomised addresses; another environment in another order, locale and time zone; clocks
//                      that are off, directories in reverse order, a heap in an order of its own and with filled
//                      blocks: surroundings/
//   after it           the stacks of main and of the run's tasks: perturbed_memory.hpp; locale, signal mask, umask,
//                      formats of the standard streams, and the flags of floating-point exceptions
//
// Both processes share the command line, the current folder, the files, and $PATH, $HOME, $WAITPOINT_...
#pragma once

#include <optional>
#include <string>

namespace waitpoint::tools {

/// Descriptors of open files that a perturbed process inherits.
struct PerturbedFiles {
  int log = -1;        ///< of events: event_log.hpp
  int durations = -1;  ///< a record of durations to replay, as text; -1: none
};

/// The end of the process.
struct ProcessEnd {
  std::optional<int> status;  ///< if it exited
  std::string cut_off;        ///< otherwise: "was terminated by ...", in a few words
};

/// BadInput if no such process can be created, before anything is run.
void check_perturbed_process_possible();

/// Starts the process with the same command line and waits for its end. Stops it after `limit_s`, or when this process
/// is interrupted. Throws BadInput if no process can be created.
ProcessEnd run_perturbed_process(const PerturbedFiles& files, double limit_s, bool (*interrupted)());

/// In a perturbed process, before the run: see above.
void perturb_surroundings();

/// In a perturbed process: its files; otherwise nothing. BadInput for an invalid variable.
std::optional<PerturbedFiles> files_of_perturbed_process();

}  // namespace waitpoint::tools
