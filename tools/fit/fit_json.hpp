// SPDX-License-Identifier: BSD-3-Clause
// The output of --json for a fit.
#pragma once

#include <string>

#include "tools/fit/robot_type.hpp"

namespace waitpoint::tools {

/// The fitted parameters, with the robot type's text.
std::string fit_json(const RobotFit& fit);

}  // namespace waitpoint::tools
