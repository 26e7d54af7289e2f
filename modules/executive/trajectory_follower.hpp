// SPDX-License-Identifier: BSD-3-Clause
// The executive of a robot that follows a trajectory: it is at its places at its times, such as a simulated robot in
// the map of a real one's log, which sees what that robot saw, when it saw it.
//
// It reads pom.position and writes trajectory.speed, the reference that `rflex` tracks. While the robot is away from
// its place by more than 0.3 m, the trajectory's time runs slower, and from 0.8 m on it waits; after half a minute
// without a second's progress the robot gives up.
#pragma once

#include <atomic>
#include <vector>

#include "modules/executive/executive_setup.hpp"
#include "modules/executive/robot_executive.hpp"
#include "modules/executive/trajectory.hpp"
#include "modules/genom/client.hpp"
#include "modules/posters/base.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::executive {

class TrajectoryFollower : public RobotExecutive {
 public:
  static constexpr const char* speed_poster = "trajectory.speed";

  explicit TrajectoryFollower(const ExecutiveSetup& setup);
  static bool takes(const ExecutiveSetup& setup) { return setup.trajectory.has_value(); }

  /// A missing module or poster is BadInput.
  void connect() override;
  /// The body of the task: starts the modules' activities, follows the trajectory, stops the robot.
  void run() override;
  void stop() override { stopping_ = true; }

  /// One: the trajectory's end.
  const std::vector<GoalRecord>& goals() const override { return goals_; }
  std::size_t current_goal() const override { return goals_.front().state == GoalState::ahead ? 0 : 1; }

 private:
  void follow();
  void drive(const posters::SpeedInput& speeds);

  genom::NameSpace& names_;
  Trajectory trajectory_;
  posters::KnownPose start_;
  genom::Client client_;
  genom::Poster<posters::SpeedReference>& speed_;
  genom::PosterLink<posters::FusedPosition> position_{"pom.position"};
  std::vector<GoalRecord> goals_;
  std::uint32_t references_ = 0;
  std::atomic<bool> stopping_ = false;
};

}  // namespace waitpoint::executive
