// SPDX-License-Identifier: BSD-3-Clause
// A run of a program: a process into which the library of fibers/posix is preloaded, and who waits for its end.
#pragma once

#include <filesystem>
#include <string>

#include "fibers/posix/record.hpp"
#include "tools/exec/exec_options.hpp"

namespace waitpoint::tools {

/// What can be run, and with what. BadInput where it cannot: there is no such program, it is linked statically, the
/// library is not installed.
struct ProgramFiles {
  explicit ProgramFiles(const std::string& name);

  std::filesystem::path program, library;
};

class ProgramRun {
 public:
  /// Runs the program to its end, with `seed` instead of the options'. What it writes goes where this process writes,
  /// or to the descriptor `output`, if there is one.
  ProgramRun(const ExecOptions& options, const ProgramFiles& files, std::uint64_t seed, int output = -1);
  ~ProgramRun();
  ProgramRun(const ProgramRun&) = delete;
  ProgramRun& operator=(const ProgramRun&) = delete;

  /// As waitpid() gives it.
  int status() const { return status_; }
  /// The exit status; -1 where a signal ended it.
  int exit_status() const;
  /// The signal that ended it; 0 if none did.
  int signal() const;
  /// Whether it came to its main().
  bool began() const { return record_->began; }
  const posix::Record& record() const { return *record_; }

 private:
  int descriptor_;
  posix::Record* record_;
  int status_ = 0;
};

}  // namespace waitpoint::tools
