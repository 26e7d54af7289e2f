// SPDX-License-Identifier: BSD-3-Clause
// The figures of many runs of a scenario: their quantiles.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "modules/bridge/run_result.hpp"

namespace waitpoint::tools {

struct Quantiles {
  std::string figure;  ///< with its unit: "driven_m"
  double least = 0, tenth = 0, median = 0, nine_tenths = 0, most = 0;
};

/// Of the figures that the runs have: goals reached of all, driven, collisions, errors, simulated time. The quantile q
/// is the smallest value that at least the share q of the runs does not exceed.
std::vector<Quantiles> quantiles_of(std::span<const bridge::RunResult> results);

/// A table for people.
std::string quantiles_text(std::span<const bridge::RunResult> results);

}  // namespace waitpoint::tools
