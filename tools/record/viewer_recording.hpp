// SPDX-License-Identifier: BSD-3-Clause
// The contents of a recording for viewers, independent of the file format:
//
//   ten times a second  the virtual time; the obstacles, if changed; each robot's true pose (world -> ROBOT)
//   at each new value   a robot's odometry, its estimated pose (world -> ROBOT/position), its laser scans
//                       (in ROBOT/position -> ROBOT/LASER), requests to its modules and their outcomes
#pragma once

#include "tools/record/module_log.hpp"
#include "tools/record/recording.hpp"
#include "tools/record/robot_posters.hpp"

namespace waitpoint::tools {

class ViewerRecording : public Recording {
 public:
  void begin(run::Experiment& experiment) final;

 protected:
  struct OfRobot {
    std::size_t number;
    std::string name;
    RobotPosters posters;
    std::unique_ptr<ModuleLog> modules;
  };

  static constexpr const char* root = "world";  ///< the root frame

  ViewerRecording(const std::filesystem::path& path, const scenario::Scenario& scenario)
      : Recording(path), scenario_(scenario) {}

 private:
  void record(const run::Experiment& experiment, Time now) final;
  void commit(const bridge::RunResult& result) final;
  void record_obstacles(const std::vector<world::Obstacle>& obstacles);
  void record_truth(const OfRobot& robot, const world::World& world, Time now);
  void record_news(OfRobot& robot);
  void record_modules(OfRobot& robot);

  // Implemented by the format.

  /// Called once per robot before the run.
  virtual void add(const OfRobot& robot) = 0;
  /// The time of receipt of the following messages.
  virtual void set_time(Time now) = 0;
  virtual void write_clock() = 0;
  virtual void write_obstacles(const std::vector<world::Shape>& shapes) = 0;
  virtual void write_transform(Time date, const std::string& parent, const std::string& child, const Pose& pose,
                               double height_m) = 0;
  virtual void write_truth(const OfRobot& robot, Time date, const world::BodyState& body) = 0;
  virtual void write_odometry(const OfRobot& robot, const posters::Odometry& odometry) = 0;
  virtual void write_position(const OfRobot& robot, const posters::PositionEstimate& position) = 0;
  /// Of the robot's laser number `laser`, in that frame.
  virtual void write_scan(const OfRobot& robot, std::size_t laser, const std::string& frame,
                          const posters::LaserReading& scan) = 0;
  virtual void write_log(const OfRobot& robot, const ModuleLog::Line& line) = 0;
  /// Called last.
  virtual void close(const bridge::RunResult& result) = 0;

  const scenario::Scenario& scenario_;
  std::vector<OfRobot> robots_;
  std::optional<std::vector<world::Shape>> meshes_;  // as shown on a plan, computed once
  std::optional<std::vector<world::Shape>> drawn_;   // the obstacles as last written
  std::optional<Time> sampled_;
};

}  // namespace waitpoint::tools
