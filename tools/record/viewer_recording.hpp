// SPDX-License-Identifier: BSD-3-Clause
// The contents of a recording for viewers, independent of the file format:
//
//   ten times a second  the virtual time; the obstacles, if changed; each robot's true pose (world -> ROBOT)
//   at each new value   a robot's odometry, its estimated pose (world -> ROBOT/position), the readings of its sensors
//                       that a module reads (with a mount: in ROBOT/position -> ROBOT/SENSOR), requests to its modules
//                       and their outcomes; the topics of its nodes of ROS that are shown, by their names, with `map`
//                       for the root frame
#pragma once

#include "tools/record/recording.hpp"
#include "tools/record/robot_posters.hpp"

namespace waitpoint::tools {

class ViewerRecording : public Recording {
 public:
  bool shows_obstacles() const final { return true; }

 protected:
  template <class S>
  using RecordedSensors = std::vector<RecordedSensor<S>>;
  struct OfRobot {
    std::size_t number;
    std::string name;
    world::Sensors::Tuple<RecordedSensors> sensors;
  };

  /// A new reading of a sensor of type S, and the topic and the frame for its messages.
  template <class S>
  struct NewReading {
    std::string topic, frame;
    const typename S::Description& description;
    const typename S::Reading& reading;
  };
  using AnyNewReading = world::Sensors::Variant<NewReading>;

  static constexpr const char* root = "world";  ///< the root frame

  ViewerRecording(const std::filesystem::path& path, const scenario::Scenario& scenario);

  const std::vector<OfRobot>& robots() const { return robots_; }

 private:
  void record(const StepNews& step) final;
  void commit(const StepNews& last, const bridge::RunResult& result) final;
  void record_truth(const OfRobot& robot, const RobotNews& news, Time now);
  void record_news(const OfRobot& robot, const RobotNews& news);
  template <class S>
  void record_readings(const OfRobot& robot, const NewReadings& readings);
  void record_lines(const OfRobot& robot, const RobotNews& news);

  // Implemented by the format.

  /// The time of receipt of the following messages.
  virtual void set_time(Time now) = 0;
  virtual void write_clock() = 0;
  virtual void write_obstacles(const std::vector<world::Shape>& shapes) = 0;
  virtual void write_transform(Time date, const std::string& parent, const std::string& child, const Pose& pose,
                               double height_m) = 0;
  virtual void write_truth(const OfRobot& robot, Time date, const Pose& pose, double height_m) = 0;
  virtual void write_odometry(const OfRobot& robot, const posters::Odometry& odometry) = 0;
  virtual void write_position(const OfRobot& robot, const posters::PositionEstimate& position) = 0;
  virtual void write_reading(const AnyNewReading& reading) = 0;
  virtual void write_shown(const nodes::ShownMessage& message, const std::string& frame) = 0;
  virtual void write_log(const OfRobot& robot, const ModuleLog::Line& line) = 0;
  /// Called last.
  virtual void close(const bridge::RunResult& result) = 0;

  std::vector<OfRobot> robots_;
};

}  // namespace waitpoint::tools
