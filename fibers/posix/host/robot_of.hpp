// SPDX-License-Identifier: BSD-3-Clause
// The robot of a hosted program.
#pragma once

#include "core/error.hpp"
#include "core/hosting/program_host.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

inline kernel::Robot& robot_of(const kernel::Scheduler& scheduler, const HostedProgram& program) {
  kernel::Robot* robot = kernel::roster(scheduler).first_robot();
  while (robot != nullptr && program.robot != robot->name) robot = robot->next;
  WAITPOINT_CHECK(robot != nullptr, "a program is hosted for a robot that is not in the run");
  return *robot;
}

}  // namespace waitpoint::posix
