// SPDX-License-Identifier: BSD-3-Clause
// The output of --json for a run, or for a series of them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "modules/bridge/run_result.hpp"

namespace waitpoint::tools {

/// The summary, with the expectations that are not met, a sentence each, and the command that repeats the run.
std::string run_json(const bridge::RunResult& result, const std::vector<std::string>& unmet, const std::string& replay);

/// The run that ended a series without a result.
struct FailedSeed {
  std::uint64_t seed = 0;
  std::string reason, replay;
};
/// The summary of all runs.
std::string runs_json(std::span<const bridge::RunResult> results, const std::optional<FailedSeed>& failed);

}  // namespace waitpoint::tools
