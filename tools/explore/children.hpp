// SPDX-License-Identifier: BSD-3-Clause
// Processes by fork, each of which does one thing, gives back some bytes, and is gone: what goes wrong in one, a crash
// included, is that one's alone. They end with this one.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace waitpoint::tools {

class Children {
 public:
  struct Ended {
    std::uint64_t number;
    int status;          ///< as waitpid() gives it
    std::string bytes;   ///< that it gave back; nothing if it was killed
    std::string errors;  ///< the beginning of what it wrote to its standard error
  };

  Children() = default;
  /// Kills those that are left.
  ~Children() { kill_from(0); }
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  /// Starts one that carries out `work`, known as `number`. What it prints is not seen.
  void start(std::uint64_t number, const std::function<std::string()>& work);
  std::size_t count() const { return running_.size(); }
  /// Waits for one to end, `timeout_ms` at most.
  std::optional<Ended> wait(int timeout_ms);
  /// Kills those of `number` or more.
  void kill_from(std::uint64_t number);

 private:
  struct Running {
    pid_t process;
    int bytes_pipe, errors_pipe;
    Ended so_far;
  };
  static void drain(int pipe, std::string& to, std::size_t most, bool& at_end);
  Ended reap(std::size_t index);

  std::vector<Running> running_;
};

/// "it was killed by signal 11 (Segmentation fault)" and what it said last; empty for one that ended by itself.
std::string death_of(const Children::Ended& ended);

}  // namespace waitpoint::tools
