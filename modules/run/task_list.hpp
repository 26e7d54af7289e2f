// SPDX-License-Identifier: BSD-3-Clause
// The tasks of a run in words, for people.
#pragma once

#include <string>

#include "fibers/kernel/task.hpp"

namespace waitpoint::run {

/// A line for each task of the robot, in the order of their making: its name, state, local time, and activity.
std::string list_tasks(const kernel::Scheduler& scheduler, const kernel::Robot& robot);

}  // namespace waitpoint::run
