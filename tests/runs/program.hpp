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

/// A command and the environment of its process.
struct Command {
  std::vector<std::string> words;             ///< the first is the executable, searched in PATH
  std::vector<std::string> environment = {};  ///< KEY=VALUE, added to this process's own
  std::filesystem::path folder = {};          ///< its working directory; empty: this process's
  std::string input = {};                     ///< the contents of its standard input
  bool random_addresses = true;               ///< address space layout randomisation
};

struct Outcome {
  int status = -1;  ///< as in the shell: 128 + signal after a signal
  std::string output, errors;

  /// The digest in the summary's last line; empty if there is none.
  std::string digest() const;
};

/// A process that runs concurrently until it is waited for.
class Process {
 public:
  explicit Process(const Command& command);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  /// Waits for it if it has not been waited for.
  ~Process();
  /// Call once.
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
