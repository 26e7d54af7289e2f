// SPDX-License-Identifier: BSD-3-Clause
// Forked processes that each do one job, return some bytes and exit. A failure in one, crashes included, does not
// affect the others. All are killed with this object.
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
  struct Limits {
    double wall_s = 0;     ///< wall clock limit of each; 0: none
    bool computes = true;  ///< expected only to compute: a blocked child is killed
  };
  struct Ended {
    std::uint64_t number;
    int status;                   ///< as from waitpid()
    std::string bytes;            ///< the result; empty if it was killed
    std::string errors;           ///< the beginning of its standard error
    std::string killed_for = {};  ///< the limit it exceeded, if any
  };

  Children() = default;
  explicit Children(const Limits& limits) : limits_(limits) {}
  /// Kills the remaining children.
  ~Children() { kill_from(0); }
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  /// Forks a child that runs `work`, known as `number`. Its standard output is discarded.
  void start(std::uint64_t number, const std::function<std::string()>& work);
  std::size_t count() const { return running_.size(); }
  /// Waits for a child to end, for at most `timeout_ms`; kills those beyond a limit.
  std::optional<Ended> wait(int timeout_ms);
  /// Asks the child that has run longest, if that is a second at least, to end by SIGTERM, and returns what it says.
  std::optional<Ended> stop_longest();
  /// Kills children with numbers from `number` up.
  void kill_from(std::uint64_t number);

 private:
  struct Running {
    pid_t process;
    int bytes_pipe, errors_pipe;
    Ended so_far;
    double started_s, looked_s;  // wall clock: at the start, and when its ticks last grew
    std::uint64_t ticks = 0;
  };
  static void drain(int pipe, std::string& to, std::size_t most, bool& at_end);
  Ended reap(std::size_t index);
  void end_those_beyond_limits();

  Limits limits_;
  double next_look_s_ = 0;  // the next check of limits, by the wall clock
  std::vector<Running> running_;
};

/// "the process was killed by signal 11 (Segmentation fault)" and the start of its standard error; empty for a normal
/// exit.
std::string death_of(const Children::Ended& ended);

}  // namespace waitpoint::tools
