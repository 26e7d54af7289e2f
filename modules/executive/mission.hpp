// SPDX-License-Identifier: BSD-3-Clause
// A round of goals as a state machine: what to do next, from what the motion reports.
//
//            start            blocked: mark what is seen, plan anew -> drive
//              |              no way round it: forget the marks ----> wait, then plan anew
//   [goal] -> plan -> drive --arrived--> next goal
//              |                tries used up --> give the goal up, next goal
//              no route: note the reason, next goal
//
// It knows no task and no clock: the executive hands in dates, positions and echoes, and carries the orders out. Waits
// are drawn from the robot's own random stream, so that robots that block each other do not try again in step.
#pragma once

#include "core/random.hpp"
#include "modules/executive/route_planner.hpp"

namespace waitpoint::executive {

struct MissionParameters {
  std::uint32_t tries_max = 8;  ///< per goal, after which it is given up
  double wait_s_min = 2, wait_s_max = 8;
  double detour_max = 3;     ///< a way round that is this many times longer is not worth it at first: wait instead
  double detour_m_min = 15;  ///< but one that is no longer than this is

  static constexpr auto fields() {
    return std::tuple(
        field("tries_max", &MissionParameters::tries_max), field("wait_s_min", &MissionParameters::wait_s_min),
        field("wait_s_max", &MissionParameters::wait_s_max), field("detour_max", &MissionParameters::detour_max),
        field("detour_m_min", &MissionParameters::detour_m_min));
  }
};

enum class GoalState : std::uint8_t {
  ahead,
  reached,
  no_route,  ///< the plan's outcome says why
  given_up,  ///< blocked too often
};

struct GoalRecord {
  Point goal;
  GoalState state = GoalState::ahead;
  PlanOutcome outcome = PlanOutcome::found;  ///< of the last plan
  std::uint32_t tries = 0;                   ///< plans that were driven
  Time date;                                 ///< when it was reached or left
};

struct Order {
  enum class Kind : std::uint8_t {
    drive,     ///< along `via_points`, then report arrived or blocked
    wait,      ///< until `until`, then report waited
    finished,  ///< all goals are dealt with
  };
  Kind kind = Kind::finished;
  std::vector<Point> via_points;
  Time until;
};

class Mission {
 public:
  /// `planner` is borrowed and must outlive the mission; its marks are the mission's to set.
  Mission(RoutePlanner& planner, const MissionParameters& parameters, const std::vector<Point>& goals,
          const RandomStream& random);

  /// What to do first, or after the motion arrived at the last via point, or after the wait is over. The order is valid
  /// until the next call.
  const Order& start(Time now, Point robot);
  const Order& arrived(Time now, Point robot);
  const Order& waited(Time now, Point robot);
  /// After the motion gave up: `echoes` are the obstacle points that it sees, in the map frame.
  const Order& blocked(Time now, Point robot, std::span<const Point> echoes);

  const std::vector<GoalRecord>& goals() const { return goals_; }
  /// The goal being driven to; equal to the number of goals when finished.
  std::size_t current() const { return current_; }

 private:
  const Order& make_for_goal(Time now, Point robot);
  const Order& drive();
  const Order& wait(Time now);
  void leave_goal(Time now, GoalState state);

  RoutePlanner& planner_;
  MissionParameters parameters_;
  std::vector<GoalRecord> goals_;
  RandomStream random_;
  std::size_t current_ = 0;
  std::uint64_t draws_ = 0;
  Plan plan_;
  Order order_;
};

}  // namespace waitpoint::executive
