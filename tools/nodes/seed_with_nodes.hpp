// SPDX-License-Identifier: BSD-3-Clause
// One run with nodes of a series over seeds: the simulation in which it takes place leaves its result in a file.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "modules/bridge/run_result.hpp"

namespace waitpoint::tools {

/// The run of this seed, by the program's arguments for the series; of its output only faults are shown.
/// std::runtime_error without a result.
bridge::RunResult run_seed_with_nodes(std::span<const std::string> arguments, std::uint64_t seed);

/// Among nodes, at a run's end: leaves its result, if the run is one of a series.
void leave_result(bridge::RunResult& result);

}  // namespace waitpoint::tools
