// SPDX-License-Identifier: BSD-3-Clause
// The executive: a task above the modules that drives the robot to its goals, one after another.
//
// It plans a route on the known map, sends `ndd` the via points as a request and waits for the report. If the way is
// blocked, it marks the laser's current echoes on the map and plans again. Marks are deleted if they leave no route:
// they may be of a moving obstacle. A goal that remains unreachable gets a report with the reason.
//
// With a period of planning again, it keeps the map that it has seen, in place of marks, plans on it in motion, and
// gives `ndd` the better route without a halt.
//
// A robot that `locate` has lost stops, turns on the spot and drives a little by turns until it has been found.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "modules/executive/looks.hpp"
#include "modules/executive/robot_executive.hpp"
#include "modules/executive/surveyor.hpp"
#include "modules/executive/whereabouts.hpp"
#include "modules/genom/client.hpp"
#include "modules/genom/settings.hpp"
#include "modules/posters/navigation.hpp"

namespace waitpoint::executive {

/// Parameters of the executive.
struct Parameters {
  PlanningParameters planning;
  MissionParameters mission;
  double mark_range_m = 3;
  Duration plan_cost_us = {};
  /// Period of planning again in motion, on the map that the robot has seen; 0: only when the way is blocked. Unless
  /// set, 0 on a known map and 200 ms on one that is not.
  Duration replan_ms = {};
  double seen_range_m = 10;
  bool start_known = true;
  double find_s = 60;

  static void fields(auto field) {
    field("planning", &Parameters::planning);
    field("mission", &Parameters::mission);
    field("mark_range_m", &Parameters::mark_range_m, "greatest distance of echoes to be marked on the map");
    field("plan_cost_us", &Parameters::plan_cost_us, "cost of planning a route");
    field("replan_ms", &Parameters::replan_ms);
    field("seen_range_m", &Parameters::seen_range_m, "what the laser sees beyond this is left out of that map");
    field("start_known", &Parameters::start_known,
          "false: the robot must be found at its start, by the module `locate`");
    field("find_s", &Parameters::find_s, "a lost robot looks for so long for what tells its localisation where it is");
  }
};

/// Overwrites the parameters that are set. BadInput for values that do not fit.
void read(genom::Settings& settings, Parameters& parameters);

class Executive : public RobotExecutive {
 public:
  /// `start` is the robot's known pose in the map frame. `random` is the executive's own stream.
  Executive(genom::NameSpace& names, const Parameters& parameters, std::shared_ptr<const KnownSpace> known,
            const posters::KnownPose& start, const std::vector<Point>& goals, const RandomStream& random);

  /// Connects its posters. A missing module, or a missing poster or one of another type, is BadInput.
  void connect() override;
  /// The body of the task: starts the modules' activities, visits the goals, round by round, stops the robot.
  void run() override;
  /// From another task: run() stops the robot and returns soon, even with goals left.
  void stop() override { stopping_ = true; }
  void reseed(const RandomStream& random) override { mission_.reseed(random); }

  const std::vector<GoalRecord>& goals() const override { return mission_.goals(); }
  std::size_t current_goal() const override { return mission_.current(); }

 private:
  void wait_for_position();
  bool lost() const { return whereabouts_.lost(!parameters_.start_known); }
  void find_robot();
  void turn_on_the_spot(Time until);
  void drive_on();
  const Order* planned(const Order& order) const;
  void stop_modules();
  void look();
  Point place_of_planning();
  void wait_until(Time until);
  std::span<const Point> reroute(std::span<const Point> via_points);
  std::optional<genom::Report> drive(std::span<const Point> via_points);

  genom::NameSpace& names_;
  Parameters parameters_;
  genom::Client client_;
  RoutePlanner planner_;
  Mission mission_;
  posters::KnownPose start_;
  std::atomic<bool> stopping_ = false;
  Looks looks_;
  Whereabouts whereabouts_;
  std::optional<Surveyor> surveyor_;  // none: it does not plan in motion
  Time next_plan_;
};

}  // namespace waitpoint::executive
