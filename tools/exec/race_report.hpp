// SPDX-License-Identifier: BSD-3-Clause
// The data races of a program's run.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

/// Several lines for each: two accesses and their source locations; if the run had several processes, by process.
/// Empty without races.
std::string races_of(const posix::Record& record);
bool has_races(const posix::Record& record);
/// True if other code than that of an earlier run accesses shared memory, if the run notes it.
bool has_unlearned_code(const posix::Record& record);
/// The code that accesses shared memory, if the run recorded it.
std::span<const std::uint64_t> code_of(const posix::Record& record);

}  // namespace waitpoint::tools
