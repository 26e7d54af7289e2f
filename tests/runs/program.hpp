// SPDX-License-Identifier: BSD-3-Clause
// The `waitpoint` program in a process of its own.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace waitpoint::runs {

/// $WAITPOINT_PROGRAM, or ../tools/waitpoint seen from this program.
std::filesystem::path program();

/// A command and the surroundings that a process finds itself in.
struct Command {
  std::vector<std::string> words;             ///< the first is the executable, searched in PATH
  std::vector<std::string> environment = {};  ///< KEY=VALUE, over this process's own
  std::filesystem::path folder = {};          ///< its current folder; empty: this process's
  std::string input = {};                     ///< what its standard input holds
  bool random_addresses = true;               ///< whether the kernel may lay out its addresses at random
};

struct Outcome {
  int status = -1;  ///< as the shell has it: 128 + signal for a death by signal
  std::string output, errors;

  /// The digest of the summary's last line; empty if there is none.
  std::string digest() const;
};

/// A process that runs beside this one until it is waited for.
class Process {
 public:
  explicit Process(const Command& command);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  /// Waits for it if nobody has.
  ~Process();
  /// Once.
  Outcome wait();

 private:
  pid_t id_ = -1;
  std::FILE* output_;
  std::FILE* errors_;
};

inline Outcome outcome_of(const Command& command) { return Process(command).wait(); }

/// `waitpoint run scenarios/<scenario> --until <until_s> <more>`
Command run_command(const std::string& scenario, const std::string& until_s, const std::vector<std::string>& more = {});

}  // namespace waitpoint::runs
