// SPDX-License-Identifier: BSD-3-Clause
// The output of --json for a program's run, or for a series of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "fibers/posix/program/record.hpp"
#include "tools/exec/program_run.hpp"

namespace waitpoint::tools {

/// How a run is named and repeated.
struct NamedRun {
  std::string program;
  std::uint64_t seed = 1;
  std::string replay;  ///< the command
};

/// How the run ended, its digest and counts, its races and misuses.
std::string exec_json(const NamedRun& named, const ProgramRun& run, const posix::Record& record);

/// A series of seeds: `failed` is the last run if that has failed, as an object of exec_json(); empty: none has.
std::string seeds_json(const std::string& program, std::uint64_t runs, std::uint64_t schedules,
                       const std::string& failed);

}  // namespace waitpoint::tools
