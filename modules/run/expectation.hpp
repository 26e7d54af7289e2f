// SPDX-License-Identifier: BSD-3-Clause
// Whether a run came to what its scenario expects.
#pragma once

#include <string>
#include <vector>

#include "modules/bridge/run_result.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::bridge {

/// One line for each expectation that is not met: "5 of 6 goals reached, expected all"; empty if all are. A deadlock is
/// never expected.
std::vector<std::string> unmet(const Expectation& expect, const RunResult& result);

/// The same in mid-run, of those that nothing can meet any more: "1 collisions, expected 0".
std::vector<std::string> broken(const Expectation& expect, const RunTotals& figures);

}  // namespace waitpoint::bridge
