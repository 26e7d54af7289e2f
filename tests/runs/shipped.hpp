// SPDX-License-Identifier: BSD-3-Clause
// The shipped scenarios, and runs of their first seconds in this process.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/run/experiment.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::runs {

/// The duration of every scenario in the repetition tests.
inline constexpr Duration first_seconds = std::chrono::seconds(20);
/// The program's default seed.
inline constexpr std::uint64_t usual_seed = 1;

/// `scenarios/<name>`, with assignments as by `--set`.
scenario::Scenario shipped(const std::string& name, const std::vector<std::string>& assignments = {});

/// Runs a scenario with the paper's modules, in one window; the result has the paths.
bridge::RunResult run(const scenario::Scenario& scenario, Duration until = first_seconds,
                      std::uint64_t seed = usual_seed, kernel::Order order = kernel::Order::fifo);

}  // namespace waitpoint::runs
