// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/mission.hpp"

#include <algorithm>
#include <limits>

namespace waitpoint::executive {
namespace {

constexpr double better_by_max = 0.9;

/// True if no obstacle that goes away can change it.
bool is_final(PlanOutcome outcome) {
  return outcome == PlanOutcome::goal_outside || outcome == PlanOutcome::goal_occupied ||
         outcome == PlanOutcome::goal_unknown;
}

}  // namespace

Mission::Mission(RoutePlanner& planner, const MissionParameters& parameters, const std::vector<Point>& goals,
                 const RandomStream& random)
    : planner_(planner), parameters_(parameters), random_(random) {
  for (const Point goal : goals) {
    goals_.emplace_back();
    goals_.back().goal = goal;
    goals_.back().visits = parameters.rounds;
  }
}

const MissionOrder& Mission::start(Time now, Point robot) { return make_for_goal(now, robot); }

const MissionOrder& Mission::arrived(Time now, Point robot) {
  WAITPOINT_CHECK(current_ < goals_.size(), "arrived without a goal");
  leave_goal(now, GoalState::reached);
  return make_for_goal(now, robot);
}

const MissionOrder& Mission::waited(Time now, Point robot) {
  WAITPOINT_CHECK(current_ < goals_.size(), "waited without a goal");
  return make_for_goal(now, robot);
}

const MissionOrder& Mission::blocked(Time now, Point robot, std::span<const Point> echoes) {
  WAITPOINT_CHECK(current_ < goals_.size(), "blocked without a goal");
  if (goals_[current_].tries >= parameters_.tries_max) {
    leave_goal(now, GoalState::given_up);
    return make_for_goal(now, robot);
  }
  const double worth_m = goals_[current_].tries < 2
                             ? std::max(parameters_.detour_m_min, parameters_.detour_max * plan_.length_m)
                             : std::numeric_limits<double>::infinity();
  planner_.space().mark(echoes);
  planner_.plan(robot, goals_[current_].goal, plan_);
  if (plan_.outcome == PlanOutcome::found && plan_.length_m <= worth_m) return drive();
  // The marks may have been those of another robot in motion.
  planner_.space().forget();
  return wait(now);
}

const MissionOrder* Mission::replanned(Point robot) {
  WAITPOINT_CHECK(current_ < goals_.size(), "replanning without a goal");
  planner_.plan(robot, goals_[current_].goal, other_);
  if (other_.outcome != PlanOutcome::found) return nullptr;
  const std::uint32_t rest = planner_.remaining_cost(path_, robot);
  const bool is_given_up = rest == ShortestPath::unreachable;
  if (!is_given_up && other_.cost > (1 - better_by_) * rest) return nullptr;
  if (!is_given_up && is_substitute_) better_by_ = std::max(better_by_, std::min(better_by_max, 2 * better_by_));
  is_substitute_ = is_given_up;
  std::swap(plan_, other_);
  path_ = planner_.path();
  order_.via_points = plan_.via_points;
  return &order_;
}

const MissionOrder& Mission::make_for_goal(Time now, Point robot) {
  for (std::size_t unreachable = 0; current_ < goals_.size(); leave_goal(now, GoalState::no_route)) {
    if (unreachable++ == goals_.size()) return wait(now);  // rounds of goals without routes take time, too
    planner_.plan(robot, goals_[current_].goal, plan_);
    if (plan_.outcome != PlanOutcome::found && planner_.space().marked()) {
      planner_.space().forget();
      planner_.plan(robot, goals_[current_].goal, plan_);
    }
    if (plan_.outcome == PlanOutcome::found) return drive();
    // A seen obstacle may move away, or turn out to be none.
    if (planner_.space().has_seen() && !is_final(plan_.outcome) && goals_[current_].tries < parameters_.tries_max)
      return wait(now);
  }
  order_.kind = MissionOrder::Kind::finished;
  order_.via_points.clear();
  return order_;
}

const MissionOrder& Mission::drive() {
  if (goals_[current_].tries++ == 0) better_by_ = parameters_.better_by;
  is_substitute_ = false;
  path_ = planner_.path();
  order_.kind = MissionOrder::Kind::drive;
  order_.via_points = plan_.via_points;
  return order_;
}

const MissionOrder& Mission::wait(Time now) {
  ++goals_[current_].tries;
  const double span = parameters_.wait_s_max - parameters_.wait_s_min;
  order_.kind = MissionOrder::Kind::wait;
  order_.via_points.clear();
  order_.until = now + Duration::from_seconds(parameters_.wait_s_min + span * random_.uniform(draws_++));
  return order_;
}

void Mission::leave_goal(Time now, GoalState state) {
  GoalRecord& goal = goals_[current_];
  if (parameters_.rounds == 0) ++goal.visits;
  if (state == GoalState::reached) ++goal.times_reached;
  const bool is_missed_before = goal.state == GoalState::no_route || goal.state == GoalState::given_up;
  if (state != GoalState::reached || !is_missed_before) {
    goal.state = state;
    goal.outcome = plan_.outcome;
    goal.date = now;
  }
  if (++current_ == goals_.size() && rounds_begun_ != parameters_.rounds) begin_next_round();
}

void Mission::begin_next_round() {
  if (parameters_.rounds > 0) ++rounds_begun_;
  current_ = 0;
  for (GoalRecord& goal : goals_) goal.tries = 0;
}

}  // namespace waitpoint::executive
