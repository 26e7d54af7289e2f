// SPDX-License-Identifier: BSD-3-Clause
// Reports of a run's processes about themselves on request, at any moment.
#pragma once

#include <string>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

/// The activities of the threads of all processes, a line each; below the one that computes the innermost places of its
/// code, "      at function at file:line". Empty before main().
std::string states_of(const posix::Record& record);

/// The thread that computes in the process that has the turn.
struct Computing {
  std::string thread;  ///< "main", or "sh: main" if there are several programs; empty if none is known
  std::string place;   ///< "function at file:line"; empty if unknown
};
Computing computing_thread(const posix::Record& record);

}  // namespace waitpoint::tools
