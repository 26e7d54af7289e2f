// SPDX-License-Identifier: BSD-3-Clause
// The executive: a task above the modules that takes the robot to its goals, one after the other.
//
// It plans a route on the known map, sends `ndd` the via points as a request and waits for the report. A way reported
// as blocked is planned anew, with what the laser sees there marked on the map; what was marked is forgotten when it
// leaves no way, for it may have been somebody passing. A goal that stays out of reach ends in a report that says why.
#pragma once

#include <atomic>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "modules/executive/mission.hpp"
#include "modules/genom/client.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::executive {

/// What can be set of the executive.
struct Parameters {
  PlanningParameters planning;
  MissionParameters mission;
  double mark_range_m = 3;     ///< echoes farther away are not marked on the map
  Duration plan_cost_us = {};  ///< what it costs to find a route

  static constexpr auto fields() {
    return std::tuple(field("planning", &Parameters::planning), field("mission", &Parameters::mission),
                      field("mark_range_m", &Parameters::mark_range_m),
                      field("plan_cost_us", &Parameters::plan_cost_us));
  }
};

class Executive {
 public:
  /// `start` is where the robot is known to be, in the map frame. `random` is the executive's own stream.
  Executive(genom::NameSpace& names, const Parameters& parameters, std::shared_ptr<const KnownSpace> known,
            const posters::KnownPose& start, const std::vector<Point>& goals, const RandomStream& random);

  /// Finds the posters that it reads. One that nobody writes, or a module that is missing, is BadInput.
  void connect();
  /// The task's own code: starts the modules' activities, visits the goals, stops the robot.
  void run();
  /// From another task: run() ends soon, with the robot stopped, whatever goals are left.
  void stop() { stopping_ = true; }

  /// What has become of each goal. While run() goes on, only for who cannot meet its task.
  const std::vector<GoalRecord>& goals() const { return mission_.goals(); }

 private:
  void start_modules();
  void wait_for_position();
  const Order* planned(const Order& order) const;
  void stop_modules();
  std::optional<genom::Report> drive(std::span<const Point> via_points);
  Point position() const;
  void look();
  std::vector<Point> seen() const;

  genom::NameSpace& names_;
  Parameters parameters_;
  genom::Client client_;
  RoutePlanner planner_;
  Mission mission_;
  posters::KnownPose start_;
  std::atomic<bool> stopping_ = false;
  std::deque<std::vector<Point>> looks_;  // near echoes in the map frame, of the last seconds
  genom::PosterLink<posters::FusedPosition> position_{"pom.position"};
  genom::PosterLink<posters::Echoes> echoes_{"sick.echoes"};
};

}  // namespace waitpoint::executive
