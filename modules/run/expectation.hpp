// SPDX-License-Identifier: BSD-3-Clause
// Compares the result of a run with the expectations of its scenario.
#pragma once

#include <string>
#include <vector>

#include "modules/bridge/run_result.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::run {

/// One line per unmet expectation: "5 of 6 goals reached, expected all"; empty if all are met. A deadlock or a run
/// without progress is always unmet.
std::vector<std::string> unmet(const scenario::Expectation& expect, const bridge::RunResult& result);

/// The same during a run, for expectations that can no longer be met: "1 collision, expected 0".
std::vector<std::string> broken(const scenario::Expectation& expect, const bridge::RunTotals& figures);

}  // namespace waitpoint::run
