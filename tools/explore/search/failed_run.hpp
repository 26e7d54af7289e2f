// SPDX-License-Identifier: BSD-3-Clause
// A run of a search that failed, or raced, and how to repeat it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "fibers/explore/schedules/token.hpp"
#include "fibers/explore/target/plan.hpp"
#include "tools/explore/runs/explore_options.hpp"
#include "tools/explore/runs/finding.hpp"

namespace waitpoint::tools {

struct FailedRun {
  std::optional<std::uint64_t> number;  ///< of its schedule; none: the default order
  ProcessFinding finding;
  exploration::Constraints constraints = {};  ///< those of its plan
  std::string enumeration = {};  ///< the exhaustive strategy that has tried it after draws; empty: the options'
};

/// "schedule 2 of strategy portfolio, seed 1"; "the default order".
std::string name_of(const FailedRun& run, const ExploreOptions& options);
Plan plan_of(const FailedRun& run, const ExploreOptions& options);
exploration::Token token_of(const FailedRun& run, const ExploreOptions& options);

/// The command that repeats the target's run with these options; with `replayed`, a token or a file's name, that
/// schedule.
std::string replay_command(const ExploreOptions& options, const std::string& replayed = "");
/// The same in gdb.
std::string debug_command(const ExploreOptions& options, const std::string& replayed);

}  // namespace waitpoint::tools
