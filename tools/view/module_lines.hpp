// SPDX-License-Identifier: BSD-3-Clause
// The log of requests to the modules of all robots, as JSON.
#pragma once

#include <deque>

#include "tools/record/module_log.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {

/// [[time, robot, "module", "text", is_bad], ...] by time: new lines of the logs, which are by robot.
Json take_lines(std::deque<ModuleLog>& logs);

}  // namespace waitpoint::tools::view
