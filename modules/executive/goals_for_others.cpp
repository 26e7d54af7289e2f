// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/goals_for_others.hpp"

namespace waitpoint::executive {

GoalsForOthers::GoalsForOthers(const ExecutiveSetup& setup) {
  goals_.reserve(setup.goals.size());
  for (const Point& goal : setup.goals) {
    GoalRecord& record = goals_.emplace_back();
    record.goal = goal;
    record.visits = 1;
  }
}

void GoalsForOthers::run() {
  while (current_ < goals_.size() && !stopping_) ended_.acquire();
}

void GoalsForOthers::stop() {
  stopping_ = true;
  ended_.release();
}

bool GoalsForOthers::end_goal(GoalState state) {
  if (current_ == goals_.size()) return false;
  GoalRecord& goal = goals_[current_];
  goal.state = state;
  goal.date = threads::now();
  if (state == GoalState::reached) ++goal.times_reached;
  ++current_;
  ended_.release();
  return true;
}

}  // namespace waitpoint::executive
