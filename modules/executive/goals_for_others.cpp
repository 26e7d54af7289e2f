// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/goals_for_others.hpp"

namespace waitpoint::executive {

GoalsForOthers::GoalsForOthers(std::span<const Point> goals) {
  goals_.reserve(goals.size());
  for (const Point& goal : goals) {
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

void GoalsForOthers::end_goal(GoalState state) {
  if (current_ == goals_.size()) return;
  GoalRecord& goal = goals_[current_];
  goal.state = state;
  goal.date = threads::now();
  if (state == GoalState::reached) ++goal.times_reached;
  ++current_;
  ended_.release();
}

}  // namespace waitpoint::executive
