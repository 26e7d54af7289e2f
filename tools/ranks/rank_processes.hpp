// SPDX-License-Identifier: BSD-3-Clause
// The processes of a run's ranks, as far as they are on this host: ends and stops, known within
// moments and whatever mpirun does.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "modules/run/ranks/transport.hpp"

namespace waitpoint::tools {

class RankProcesses {
 public:
  /// Collective.
  explicit RankProcesses(run::Transport& transport);
  ~RankProcesses();
  RankProcesses(const RankProcesses&) = delete;
  RankProcesses& operator=(const RankProcesses&) = delete;

  // False if not known.
  bool has_ended(int rank) const;
  /// By a signal or a debugger.
  bool is_stopped(int rank) const;
  /// All ranks that have, "rank 1, rank 2"; empty: none is known.
  std::string ended() const;

 private:
  struct Watched {
    pid_t number;
    int descriptor;  // -1: on another host, or this one
  };
  std::vector<Watched> processes_;  // by rank
};

}  // namespace waitpoint::tools
