// SPDX-License-Identifier: BSD-3-Clause
// A run for each seed of a range: a row for each, in the order of the seeds, as they come, and quantiles of all.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "modules/bridge/run_result.hpp"
#include "modules/scenario/scenario.hpp"
#include "tools/run/run_options.hpp"

namespace waitpoint::tools {

/// A run of this seed; `replay` is the line that repeats it.
using RunOfSeed = std::function<bridge::RunResult(std::uint64_t seed, const std::string& replay)>;

/// Makes `options.jobs` runs at once, in processes of their own if it is more than one. A run that fails by an
/// exception or dies ends the series: the next seed's would fail likewise. Returns the exit status.
int run_seeds(const RunOptions& options, const scenario::Scenario& scenario, const RunOfSeed& run);

}  // namespace waitpoint::tools
