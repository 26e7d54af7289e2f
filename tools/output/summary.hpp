// SPDX-License-Identifier: BSD-3-Clause
// The results of a run, as text and as JSON.
#pragma once

#include <span>
#include <string>

#include "modules/bridge/run_result.hpp"

namespace waitpoint::tools {

/// The text shown at the end of a run: totals of all robots, a table of several robots, missed goals, periodic tasks
/// with missed deadlines, warnings, the report of a deadlock or of no progress if any, and finally the digest. Ends
/// with a newline.
std::string summary_text(const bridge::RunResult& result);

/// One JSON object; keys are the names of the fields with their units; `robots` has the same keys for each robot, and
/// its goals. Ends with a newline.
std::string summary_json(const bridge::RunResult& result);

/// Several runs: {"runs": [...]}, one object each as above.
std::string summary_json(std::span<const bridge::RunResult> results);

/// For `--seeds`: the head of the table, and a row for each run; see also quantiles.hpp.
std::string seeds_head();
std::string seeds_row(const bridge::RunResult& result);

}  // namespace waitpoint::tools
