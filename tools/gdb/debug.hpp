// SPDX-License-Identifier: BSD-3-Clause
// Runs a program in gdb, with the commands of tools/gdb loaded.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/exec/exec_options.hpp"
#include "tools/explore/runs/explore_options.hpp"

namespace waitpoint::tools {

/// `waitpoint gdb [OPTIONS OF GDB] -- PROGRAM ...`
struct DebugOptions {
  std::vector<std::string> gdb_options;
  bool own = false;                        ///< the words after `--` are a command of waitpoint
  std::vector<std::string> words;          ///< not empty
  std::optional<ExecOptions> program;      ///< of the command `waitpoint exec`
  std::optional<ExploreOptions> replayed;  ///< of `waitpoint explore --replay` of a program
};

/// The command: what precedes "--" is for gdb.
void declare(Command& command, DebugOptions& options);

/// Replaces this process by gdb. BadInput if gdb, the program or the commands are missing; the commands are looked up
/// beside this program, in its installation's share/waitpoint/gdb, and in the library's.
[[noreturn]] void debug(const DebugOptions& options);

}  // namespace waitpoint::tools
