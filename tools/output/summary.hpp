// SPDX-License-Identifier: BSD-3-Clause
// What came out of a run, for people and for programs.
#pragma once

#include <span>
#include <string>

#include "modules/bridge/run_result.hpp"

namespace waitpoint::tools {

/// The text shown at the end of a run: figures of all robots, a table of the robots if there are several, goals that
/// were not reached, periodic tasks that missed deadlines, warnings, the report of a deadlock or of no progress if any,
/// and last the digest. Ends with a newline.
std::string summary_text(const bridge::RunResult& result);

/// One JSON object, figures by the names of the fields with their units; `robots` has the same figures for each, and
/// its goals one by one. Ends with a newline.
std::string summary_json(const bridge::RunResult& result);

/// Several runs: {"runs": [...]}, one object each as above.
std::string summary_json(std::span<const bridge::RunResult> results);

/// For `--seeds`: the table's head, and a row for each run.
std::string seeds_head();
std::string seeds_row(const bridge::RunResult& result);

}  // namespace waitpoint::tools
