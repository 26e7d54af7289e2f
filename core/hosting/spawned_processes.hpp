// SPDX-License-Identifier: BSD-3-Clause
// Processes of programs, which their owner starts and awaits by the calls of POSIX. They are simulated if the owner is:
// these calls are then those of the layer that was loaded in front of the C library.
#pragma once

#include <sys/types.h>

#include <vector>

#include "core/hosting/program_host.hpp"

namespace waitpoint {

class SpawnedProcesses final : public ProgramHost {
 public:
  void add(const HostedProgram& program) override { processes_.push_back({program}); }
  void start(std::size_t program) override;
  std::optional<ProgramEnd> end_of(std::size_t program) const override { return processes_[program].end; }

  /// Notes the end of any child; waits for one, unless `flags` has WNOHANG. True if a child has ended.
  bool await_end(int flags);
  /// Notes the ends that have come.
  void note_ends();
  /// Sends a signal to a program that runs.
  void send(std::size_t program, int signal) const;

 private:
  struct Process {
    HostedProgram program;
    pid_t id = 0;
    std::optional<ProgramEnd> end = {};
  };
  std::vector<Process> processes_;
};

}  // namespace waitpoint
