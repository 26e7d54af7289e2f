// SPDX-License-Identifier: BSD-3-Clause
// Programs on POSIX threads, by program.c under `waitpoint explore -- PROGRAM`.
#pragma once

#include <cstdint>
#include <string>

#include "tests/fibers/explore/completeness/interpreter.hpp"

namespace waitpoint::completeness {

/// The programs that run them, and a folder for their files.
struct ExecTools {
  std::string waitpoint;
  std::string interpreter;
  std::string folder;
};

/// The outcomes of `program` under all schedules of `strategy`, or the first `schedules_max`. Of a cycle the members
/// are only known if each waits for a mutex or a thread's end for the first time: another is "cycle ?".
Covered cover_by_exec(const ExecTools& tools, const Program& program, const std::string& strategy,
                      std::uint64_t schedules_max);

}  // namespace waitpoint::completeness
