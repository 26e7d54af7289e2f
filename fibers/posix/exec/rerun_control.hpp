// SPDX-License-Identifier: BSD-3-Clause
// The page by which the explorer asks a process for further runs (rerun.hpp). It is at the end of the record's memory,
// and keeps its contents from run to run.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::posix {

struct RerunControl {
  /// How a run has ended, for the explorer, which waits for it.
  enum Ended : std::uint32_t {
    not_yet,
    in_place,   ///< its process can make the next one
    as_process  ///< with its process: the answer of the server (fork_server.hpp) is on its way
  };

  std::atomic<std::uint32_t> asked;  ///< grows with each run that is asked for; a futex, as is the next
  std::atomic<std::uint32_t> ended;
  bool is_to_leave;  ///< the process ends instead of making another run
  int status;        ///< as of waitpid(), of a run that ended in place
};

inline RerunControl& rerun_control() { return *reinterpret_cast<RerunControl*>(control_address); }

}  // namespace waitpoint::posix
