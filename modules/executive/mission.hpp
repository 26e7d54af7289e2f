// SPDX-License-Identifier: BSD-3-Clause
// Rounds of goals as a state machine: the next order, from the reports of the motion.
//
//            start            blocked: mark the echoes, plan again -> drive
//              |              no detour: delete the marks --------> wait, then plan again
//   [goal] -> plan -> drive --arrived--> next goal
//              |                tries used up --> abandon the goal, next goal
//              no route: note the reason, next goal; no route to any goal -> wait, then next goal
//
// After the last goal of a round comes the first of the next. Memory does not grow with the rounds.
//
// It is independent of tasks and clocks: the executive provides dates, positions and echoes, and executes the orders.
// Waits are drawn from the robot's own random stream, so that robots that block each other do not retry in step.
#pragma once

#include "core/random.hpp"
#include "modules/executive/route_planner.hpp"

namespace waitpoint::executive {

struct MissionParameters {
  std::uint32_t rounds = 1;
  std::uint32_t tries_max = 8;
  double wait_s_min = 2, wait_s_max = 8;
  double detour_max = 3;
  double detour_m_min = 15;
  double better_by = 0.05;

  static void fields(auto field) {
    field("rounds", &MissionParameters::rounds, "number of visits to each goal; 0: without end");
    field("tries_max", &MissionParameters::tries_max, "per visit, before the goal is abandoned");
    field("wait_s_min", &MissionParameters::wait_s_min, "least time of a wait before the next try,");
    field("wait_s_max", &MissionParameters::wait_s_max, "and the greatest; it is drawn");
    field("detour_max", &MissionParameters::detour_max,
          "a detour longer by this factor is not taken at first: wait instead");
    field("detour_m_min", &MissionParameters::detour_m_min, "unless it is no longer than this");
    field("better_by", &MissionParameters::better_by,
          "in motion, another route is taken if it costs less by this part");
  }
};

enum class GoalState : std::uint8_t {
  ahead,
  reached,
  no_route,  ///< reason in the plan's outcome
  given_up,  ///< blocked too often
};

struct GoalRecord {
  Point goal;
  std::uint32_t tries = 0;   ///< plans executed in this round
  std::uint64_t visits = 0;  ///< of all rounds; in rounds without end, those that have ended
  std::uint64_t times_reached = 0;
  // Of the last visit that missed it, or else of the last that has ended.
  GoalState state = GoalState::ahead;
  PlanOutcome outcome = PlanOutcome::found;  ///< of its last plan
  Time date;                                 ///< of reaching or abandoning it
};

struct MissionOrder {
  enum class Kind : std::uint8_t {
    drive,     ///< along `via_points`, then report arrived or blocked
    wait,      ///< until `until`, then report waited
    finished,  ///< no goals are left
  };
  Kind kind = Kind::finished;
  std::vector<Point> via_points;
  Time until;
};

class Mission {
 public:
  /// `planner` is borrowed and must outlive the mission, which alone sets its marks.
  Mission(RoutePlanner& planner, const MissionParameters& parameters, const std::vector<Point>& goals,
          const RandomStream& random);

  /// Waits are drawn from this stream from now on.
  void reseed(const RandomStream& random) { random_ = random; }

  /// The next order: at the start, after arrival at the last via point, or after a wait. Valid until the next call.
  const MissionOrder& start(Time now, Point robot);
  const MissionOrder& arrived(Time now, Point robot);
  const MissionOrder& waited(Time now, Point robot);
  /// The order after blocked motion; `echoes` are the visible obstacle points in the map frame.
  const MissionOrder& blocked(Time now, Point robot, std::span<const Point> echoes);

  /// In motion, on a map that changes: the order of a better route to the present goal, or null to keep the present
  /// one. A route with a cell that can no longer be kept is given up for any other. The required gain of another one
  /// doubles when it takes the place of such a substitute: a narrow gap may seem open in one scan and closed in the
  /// next.
  const MissionOrder* replanned(Point robot);

  const std::vector<GoalRecord>& goals() const { return goals_; }
  /// Index of the current goal; the number of goals when finished.
  std::size_t current() const { return current_; }

 private:
  const MissionOrder& make_for_goal(Time now, Point robot);
  const MissionOrder& drive();
  const MissionOrder& wait(Time now);
  void leave_goal(Time now, GoalState state);
  void begin_next_round();

  RoutePlanner& planner_;
  MissionParameters parameters_;
  std::vector<GoalRecord> goals_;
  RandomStream random_;
  std::size_t current_ = 0;
  std::uint32_t rounds_begun_ = 1;
  std::uint64_t draws_ = 0;
  RoutePlan plan_, other_;
  std::vector<CellIndex> path_;  // of plan_
  double better_by_ = 0;         // as of now, for the present goal
  bool is_substitute_ = false;   // the present route, of one that was given up
  MissionOrder order_;
};

}  // namespace waitpoint::executive
