// SPDX-License-Identifier: BSD-3-Clause
// What --json prints of a schedule that --replay has repeated.
#pragma once

#include <string>

#include "tools/explore/replay/replay_record.hpp"

namespace waitpoint::tools {

/// `summary`: of a scenario's run, an object of JSON; empty for a program.
std::string replay_json(const ExploreOptions& options, const ReplayRecord& record, const Finding& finding,
                        const std::string& summary);

}  // namespace waitpoint::tools
