// SPDX-License-Identifier: BSD-3-Clause
// A program in a process of its own, into which the library of fibers/posix is preloaded.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tools/exec/program_list.hpp"
#include "tools/exec/run_memory.hpp"

namespace waitpoint::tools {

/// What can be run, and with what. BadInput where it cannot: there is no such program, it is linked statically, the
/// library is not installed.
struct ProgramFiles {
  explicit ProgramFiles(const std::vector<std::string>& words);

  /// The files of the programs.
  std::vector<std::string> named() const;

  ProgramList programs;
  std::filesystem::path program, library;  ///< the process's
  bool instrumented = false;               ///< by -fsanitize=thread; a layer with a runtime for that is the library
};

/// What the environment of the process holds beside what is there: "NAME=VALUE". The record's descriptor is inherited.
std::vector<std::string> environment_of(const ProgramFiles& files, const RunMemory& memory);

/// Exit status where a program cannot be run.
inline constexpr int exec_failed = 125;

/// Starts the process of the programs. It reads and writes where this process does, but for a
/// descriptor `output`, if it is none of -1, that takes both of its streams. It ends with this process.
pid_t start_program(const ProgramFiles& files, const RunMemory& memory, int output = -1);

}  // namespace waitpoint::tools
