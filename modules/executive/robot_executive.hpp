// SPDX-License-Identifier: BSD-3-Clause
// The task above a robot's modules that carries out its mission: the executive of this folder, or a script.
#pragma once

#include <vector>

#include "modules/executive/mission.hpp"

namespace waitpoint::executive {

class RobotExecutive {
 public:
  virtual ~RobotExecutive() = default;

  /// Connects its posters. A missing module, or a missing poster or one of another type, is BadInput.
  virtual void connect() = 0;
  /// The body of the task.
  virtual void run() = 0;
  /// From another task: run() stops the robot and returns soon, even with goals left.
  virtual void stop() = 0;

  /// From another task: its draws from now on are of this stream, its own of another seed. Without draws: nothing.
  virtual void reseed(const RandomStream&) {}

  /// The state of each goal. While run() is active, only from tasks that cannot run concurrently with it.
  virtual const std::vector<GoalRecord>& goals() const = 0;
  /// From another task, of software that drives the robot: the present goal has ended. False: the executive drives.
  virtual bool end_goal(GoalState) { return false; }
  /// Index of the goal that it is on its way to; the number of goals when it has none.
  virtual std::size_t current_goal() const = 0;
};

}  // namespace waitpoint::executive
