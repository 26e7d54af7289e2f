// SPDX-License-Identifier: BSD-3-Clause
// A program in gdb, with the commands of tools/gdb loaded.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/exec/exec_options.hpp"

namespace waitpoint::tools {

/// `waitpoint gdb [OPTIONS OF GDB] -- PROGRAM ...`
struct DebugOptions {
  std::vector<std::string> gdb_options;
  bool own = false;                    ///< the words after `--` are a command of this program
  std::vector<std::string> words;      ///< at least one
  std::optional<ExecOptions> program;  ///< of `waitpoint exec`, where that is the command
};

/// Becomes gdb. BadInput where there is no gdb, no such program, or the commands are not found: beside this program, in
/// share/waitpoint/gdb of where it is installed, or where its library was.
[[noreturn]] void debug(const DebugOptions& options);

}  // namespace waitpoint::tools
