// SPDX-License-Identifier: BSD-3-Clause
// What --json prints of a fit.
#pragma once

#include <string>

#include "tools/fit/robot_type.hpp"

namespace waitpoint::tools {

/// What was fitted, with the robot type's text.
std::string fit_json(const RobotFit& fit);

}  // namespace waitpoint::tools
