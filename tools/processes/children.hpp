// SPDX-License-Identifier: BSD-3-Clause
// Forked processes that each do one job at a time: bytes in, bytes out. A failure in one, crashes included, does not
// affect the others. All are killed with this object.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace waitpoint::tools {

class Children {
 public:
  struct Limits {
    double wall_s = 0;       ///< wall clock limit of each job; 0: none
    bool computes = true;    ///< expected only to compute: a blocked child is killed
    bool is_reused = false;  ///< a child does any number of jobs; else it exits after one
  };
  struct Ended {
    std::uint64_t number;
    int status;                   ///< as from waitpid()
    std::string bytes;            ///< the result; empty if it was killed
    std::string errors;           ///< the beginning of its standard error
    std::string killed_for = {};  ///< the limit it exceeded, if any
  };

  using Work = std::function<std::string(std::string_view job)>;

  /// `work` is called in the children.
  Children(Work work, const Limits& limits) : work_(std::move(work)), limits_(limits) {}
  /// Kills the remaining children.
  ~Children();
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  /// A child, forked unless one is free, does the job, known as `number`. Its standard output is discarded.
  void start(std::uint64_t number, const std::string& job);
  /// The number of jobs that are being done.
  std::size_t count() const { return running_.size(); }
  /// Waits for a job to end, for at most `timeout_ms`; kills those beyond a limit.
  std::optional<Ended> wait(int timeout_ms);
  /// Asks the child that has run longest, if that is a second at least, to end by SIGTERM, and returns its answer, if
  /// it comes in time.
  std::optional<Ended> stop_longest(double patience_s);
  /// Kills the children of jobs from `number` up.
  void kill_from(std::uint64_t number);

 private:
  struct Running {
    pid_t process;
    int jobs, errors;  // sockets: of jobs and their results, and of its standard error
    Ended so_far = {};
    double started_s = 0, looked_s = 0;  // wall clock: at the start of its job, and when its ticks last grew
    std::uint64_t ticks = 0;
  };
  static void drain(int socket, std::string& to, std::size_t most, bool& at_end);
  Running make() const;
  [[noreturn]] void carry_out(int jobs, int errors) const;
  Ended take(std::size_t index);
  Ended reap(std::size_t index);
  void end_those_beyond_limits();

  Work work_;
  Limits limits_;
  double next_look_s_ = 0;  // the next check of limits, by the wall clock
  std::vector<Running> running_, free_;
};

/// "the process was killed by signal 11 (Segmentation fault)" and the start of its standard error; empty for a normal
/// exit.
std::string death_of(const Children::Ended& ended);

}  // namespace waitpoint::tools
