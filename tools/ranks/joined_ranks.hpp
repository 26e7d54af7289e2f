// SPDX-License-Identifier: BSD-3-Clause
// A run of several processes: their start by mpirun, and in each of them its link to the others.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "modules/run/ranks/ranks.hpp"

namespace waitpoint::tools {

/// True in one of several processes that mpirun has started.
bool is_rank();

/// Replaces this process by mpirun, which starts `ranks` processes of this program with the arguments. BadInput if
/// mpirun or the library for it is not there.
[[noreturn]] void start_ranks(int ranks, std::span<const std::string> arguments);

/// The link to the other ranks. BadInput if the library is not there, or if there are not as many ranks as `wanted`; 1:
/// any number.
std::unique_ptr<run::Transport> join_ranks(int wanted);

/// Thrown on rank 1, which reports it in place of the leader.
struct LeaderLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Heeds what happens during waits. The leader tells of a rank that does not come, and throws std::runtime_error after
/// an interruption, or after `limit_s` (0: never); others throw after an interruption that the leader does not heed.
run::Ranks::Waiting watch_over(run::Transport& transport, double limit_s);

}  // namespace waitpoint::tools
