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
  struct Limits {
    double wall_s = 0;     ///< of the wall clock, for each; 0: none
    bool computes = true;  ///< nothing but computing is expected: one that waits is ended, too
  };
  struct Ended {
    std::uint64_t number;
    int status;                   ///< as waitpid() gives it
    std::string bytes;            ///< that it gave back; nothing if it was killed
    std::string errors;           ///< the beginning of what it wrote to its standard error
    std::string killed_for = {};  ///< beyond a limit: which
  };

  Children() = default;
  explicit Children(const Limits& limits) : limits_(limits) {}
  /// Kills those that are left.
  ~Children() { kill_from(0); }
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  /// Starts one that carries out `work`, known as `number`. What it prints is not seen.
  void start(std::uint64_t number, const std::function<std::string()>& work);
  std::size_t count() const { return running_.size(); }
  /// Waits for one to end, `timeout_ms` at most; ends those that are beyond a limit.
  std::optional<Ended> wait(int timeout_ms);
  /// Kills those of `number` or more.
  void kill_from(std::uint64_t number);

 private:
  struct Running {
    pid_t process;
    int bytes_pipe, errors_pipe;
    Ended so_far;
    double started_s, looked_s;  // by the wall clock: at its beginning, and when its ticks were seen to grow
    std::uint64_t ticks = 0;
  };
  static void drain(int pipe, std::string& to, std::size_t most, bool& at_end);
  Ended reap(std::size_t index);
  void end_those_beyond_limits();

  Limits limits_;
  double next_look_s_ = 0;  // at the limits, by the wall clock
  std::vector<Running> running_;
};

/// "it was killed by signal 11 (Segmentation fault)" and what it said last; empty for one that ended by itself.
std::string death_of(const Children::Ended& ended);

}  // namespace waitpoint::tools
