// SPDX-License-Identifier: BSD-3-Clause
// The robot whose modules a log is replayed to.
#pragma once

#include "modules/scenario/scenario.hpp"
#include "tools/replay/log_options.hpp"

namespace waitpoint::tools {

/// The modules that the options name, with the parameters of their scenario and of --set. BadInput for names that are
/// not among the modules.
scenario::RobotScenario replayed_robot(const LogOptions& options);

}  // namespace waitpoint::tools
