// SPDX-License-Identifier: BSD-3-Clause
// Whether a run came to what its scenario expects.
#pragma once

#include <string>
#include <vector>

#include "modules/bridge/run_result.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::run {

/// One line for each expectation that is not met: "5 of 6 goals reached, expected all"; empty if all are. A deadlock is
/// never expected.
std::vector<std::string> unmet(const scenario::Expectation& expect, const bridge::RunResult& result);

/// The same in mid-run, of those that nothing can meet any more: "1 collisions, expected 0".
std::vector<std::string> broken(const scenario::Expectation& expect, const bridge::RunTotals& figures);

}  // namespace waitpoint::run
