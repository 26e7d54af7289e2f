// SPDX-License-Identifier: BSD-3-Clause
// A program in gdb, with the commands of tools/gdb loaded.
#pragma once

#include "tools/options.hpp"

namespace waitpoint::tools {

/// Becomes gdb. BadInput where there is no gdb, no such program, or the commands are not found: beside this program, in
/// share/waitpoint/gdb of where it is installed, or where its library was.
[[noreturn]] void debug(const DebugOptions& options);

}  // namespace waitpoint::tools
