// SPDX-License-Identifier: BSD-3-Clause
// The page by which the explorer asks a process for further runs (rerun.hpp), or for snapshots (snapshot.hpp). It is at
// the end of the record's memory, and keeps its contents from run to run.
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

  /// Of a run, for the explorer: see snapshot.hpp.
  struct Snapshot {
    int process;
    std::uint32_t decision;
    std::int64_t cost_ns;  ///< processor time since the one before
  };
  static constexpr std::uint32_t snapshots_max = 200;
  char listener[8];              ///< the address at which snapshots ask for requests, in the abstract name space
  std::uint32_t listener_bytes;  ///< of it
  std::uint32_t room;            ///< as many snapshots may the next run make of itself
  bool at_first_only;            ///< at the first decision only
  std::uint32_t snapshots_made;
  Snapshot snapshots[snapshots_max];
};
static_assert(sizeof(RerunControl) <= control_bytes);

inline RerunControl& rerun_control() { return *reinterpret_cast<RerunControl*>(control_address); }

}  // namespace waitpoint::posix
