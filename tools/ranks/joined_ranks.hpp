// SPDX-License-Identifier: BSD-3-Clause
// A run of several processes: in each of them its link to the others, and the watch over them.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "modules/run/ranks/ranks.hpp"
#include "tools/ranks/rank_processes.hpp"

namespace waitpoint::tools {

/// BadInput if the library for ranks is not there.
void check_for_ranks();

/// The link to the other ranks. BadInput if the library is not there, or if there are not as many ranks as `wanted`; 1:
/// any number.
std::unique_ptr<run::Transport> join_ranks(int wanted);

/// Thrown on the first of the other ranks, which reports it in place of the leader.
struct LeaderLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reacts to events during waits. The leader throws std::runtime_error after another rank's end, an interruption, or
/// `limit_s` (0: never), and tells of a rank that does not come; others throw after the leader's end, or an
/// interruption that it does not heed.
run::Ranks::Waiting watch_over(run::Transport& transport, const RankProcesses& processes, double limit_s);

}  // namespace waitpoint::tools
