// SPDX-License-Identifier: BSD-3-Clause
// The executive: a task above the modules that takes the robot to its goals, one after the other.
//
// It plans a route on the known map, sends `ndd` the via points as a request and waits for the report. A way reported
// as blocked is planned anew, with what the laser sees there marked on the map; what was marked is forgotten when it
// leaves no way, for it may have been somebody passing. A goal that stays out of reach ends in a report that says why.
#pragma once

#include <string>
#include <vector>

#include "modules/executive/route_planner.hpp"
#include "modules/genom/client.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::executive {

/// What can be set of the executive.
struct Parameters {
  PlanningParameters planning;
  std::uint32_t tries_max = 6;                          ///< plans for one goal
  Duration pause_ms = std::chrono::milliseconds(2000);  ///< before trying again where no way was left
  double mark_range_m = 3;                              ///< echoes farther away are not marked on the map

  static constexpr auto fields() {
    return std::tuple(field("planning", &Parameters::planning), field("tries_max", &Parameters::tries_max),
                      field("pause_ms", &Parameters::pause_ms), field("mark_range_m", &Parameters::mark_range_m));
  }
};

/// What became of a goal.
struct GoalReport {
  bool ended = false;  ///< there is a report
  bool reached = false;
  Time date;
  std::string text;  ///< "reached", or why not
};

class Executive {
 public:
  /// `start` is where the robot is known to be, in the map frame.
  Executive(genom::NameSpace& names, const Parameters& parameters, OccupancyGrid map, const posters::KnownPose& start,
            std::vector<Point> goals);

  /// Finds the posters that it reads. One that nobody writes, or a module that is missing, is BadInput.
  void connect();
  /// The task's own code: starts the modules' activities, visits the goals, stops the robot.
  void run();

  /// One for every goal.
  const std::vector<GoalReport>& reports() const { return reports_; }
  const RoutePlanner& planner() const { return planner_; }

 private:
  void start_modules();
  void wait_for_position();
  void stop_modules();
  GoalReport visit(Point goal);
  genom::Report drive(std::size_t points);
  Point position() const;
  void mark_obstacles();

  genom::NameSpace& names_;
  Parameters parameters_;
  genom::Client client_;
  RoutePlanner planner_;
  posters::KnownPose start_;
  std::vector<Point> goals_;
  std::vector<GoalReport> reports_;
  genom::PosterLink<posters::FusedPosition> position_{"pom.position"};
  genom::PosterLink<posters::Echoes> echoes_{"sick.echoes"};
  Plan plan_;
};

}  // namespace waitpoint::executive
