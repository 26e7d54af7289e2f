// SPDX-License-Identifier: BSD-3-Clause
// A program in a separate process, with the library of fibers/posix preloaded.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "fibers/explore/strategies/switch_points.hpp"
#include "fibers/posix/traps/access_instruction.hpp"
#include "tools/exec/program_list.hpp"
#include "tools/exec/run_memory.hpp"

namespace waitpoint::tools {

/// The programs' files and the library. BadInput if they are missing, or a program is linked statically.
struct ProgramFiles {
  /// `quiet`: a session prints no line about its programs' ends, unless one has failed.
  /// `named`: libraries, as for watched_libraries().
  explicit ProgramFiles(const std::vector<std::string>& words, bool quiet = false, SwitchAt at = SwitchAt::calls,
                        const std::vector<std::string>& named = {});

  /// The files of the programs.
  std::vector<std::string> named() const;

  ProgramList programs;
  std::filesystem::path program, library;  ///< of the first process
  std::vector<std::string> words;          ///< its arguments, from its name on
  bool instrumented = false;               ///< with -fsanitize=thread
  /// Of the first process's program and its watched libraries, if it is not instrumented and accesses are to be switch
  /// points.
  std::vector<posix::AccessInstruction> accesses;
  std::vector<posix::AccessLibrary> libraries;

  /// True if accesses are switch points; the library then includes the runtime of a race detector.
  bool watches_accesses() const { return instrumented || !accesses.empty(); }

 private:
  void add_libraries(const std::vector<std::string>& named);
};

/// Additions to the environment of the process: "NAME=VALUE". The record's descriptor is inherited.
std::vector<std::string> environment_of(const ProgramFiles& files, const RunMemory& memory);

/// Exit status if a program cannot be run.
inline constexpr int exec_failed = 125;

/// Descriptors for the output streams of a program; -1: this process's.
struct OutputStreams {
  OutputStreams(int both = -1) : output(both), errors(both) {}  // NOLINT(google-explicit-constructor)
  OutputStreams(int of_output, int of_errors) : output(of_output), errors(of_errors) {}

  int output, errors;
};

/// Starts the process of the programs, with this process's input. Killed with this process.
pid_t start_program(const ProgramFiles& files, const RunMemory& memory, OutputStreams streams = {});

}  // namespace waitpoint::tools
