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

#include "modules/executive/executive_setup.hpp"
#include "modules/executive/looks.hpp"
#include "modules/executive/robot_executive.hpp"
#include "modules/executive/surveyor.hpp"
#include "modules/executive/whereabouts.hpp"
#include "modules/genom/client.hpp"
#include "modules/posters/navigation.hpp"

namespace waitpoint::executive {

class Executive : public RobotExecutive {
 public:
  explicit Executive(const ExecutiveSetup& setup);
  static bool takes(const ExecutiveSetup& setup) { return !setup.goals.empty(); }

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
  const MissionOrder* planned(const MissionOrder& order) const;
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
