// SPDX-License-Identifier: BSD-3-Clause
// The executive of a robot that software outside of its modules drives: goals are shown to it one after the other, and
// it reports how each ended.
#pragma once

#include <atomic>
#include <vector>

#include "fibers/sync/threads.hpp"
#include "modules/executive/executive_setup.hpp"
#include "modules/executive/robot_executive.hpp"

namespace waitpoint::executive {

class GoalsForOthers : public RobotExecutive {
 public:
  explicit GoalsForOthers(const ExecutiveSetup& setup);
  static bool takes(const ExecutiveSetup& setup) { return setup.is_for_others && !setup.goals.empty(); }

  void connect() override {}
  /// Returns when the last goal has ended.
  void run() override;
  void stop() override;

  /// Nothing after the last one.
  bool end_goal(GoalState state) override;

  const std::vector<GoalRecord>& goals() const override { return goals_; }
  std::size_t current_goal() const override { return current_; }

 private:
  std::vector<GoalRecord> goals_;
  std::size_t current_ = 0;
  std::atomic<bool> stopping_ = false;
  threads::counting_semaphore<> ended_{0};
};

}  // namespace waitpoint::executive
