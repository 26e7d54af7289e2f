// SPDX-License-Identifier: BSD-3-Clause
// The bridge of one robot: connects its hardware posters to values of the world, by the scenario's table.
//
//   device value            poster type       direction
//   base.command            BaseCommand       poster -> world
//   base.reading            BaseReading       world -> poster
//   topic.pose              Localisation      nodes of ROS -> poster
//   NAME.reading            S::Reading        world -> poster, for every sensor of every type S
//                                                             (world/sensors/types/sensors.hpp)
//   NAME.command            S::Command        poster -> world, if S has one
//
// The base's controller switches the sonars, and reports their ranges and the battery's voltage, too.
//
// After each step of the world the bridge records the body's
// state, publishes the readings that are due, and reads the commands for the next step. In simulation it is a task of
// its robot in the world's phase; on real threads the world's thread executes it. Each new write of a command counts,
// also with the same value: a base's watchdog expects commands to be repeated.
//
// Devices are off when the robot's battery is empty: no readings, no commands.
//
// Data of a serial line arrive with their last byte, also between steps; on real threads at the first step after it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fibers/sync/threads.hpp"
#include "modules/bridge/body_command.hpp"
#include "modules/bridge/reading_line.hpp"
#include "modules/genom/name_space.hpp"
#include "modules/posters/base.hpp"
#include "modules/posters/from_topics.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/timed_sensor.hpp"
#include "world/world.hpp"

namespace waitpoint::bridge {

/// Period of a base controller's reports (the period requested from RFLEX for its system report).
inline constexpr Duration base_report_period = std::chrono::milliseconds(20);

class RobotBridge {
 public:
  /// Creates the posters of the readings. An unknown device, or a device or poster in two rows, is BadInput.
  RobotBridge(const scenario::RobotScenario& robot, world::World& world, world::BodyId body, genom::NameSpace& names);

  /// Connects the posters of the commands, once the modules exist. A poster without a writer is BadInput.
  void connect();

  /// Before the run: each command given to the body is also appended to `log`, which must outlive the run.
  void set_command_log(std::vector<BodyCommand>& log) { command_log_ = &log; }

  /// A pose that a node has published: at the next exchange it is in the poster that the table has for `topic.pose`;
  /// false if there is none.
  bool take(const posters::PoseOfTopic& pose);

  /// The exchange after a step of the world, and once before the first; readings are dated `date`.
  void exchange(Time date);

  /// The body of the bridge's task: one exchange at once and one after each stepped(); never returns.
  void run();
  void stepped() { stepped_.release(); }
  /// Adds the memory that stepped() touches.
  void add_step_to(WorkingSet& set) const { set.add(stepped_); }

 private:
  struct NoLine {
    explicit NoLine(Duration) {}
  };
  /// A sensor of type S.
  template <class S>
  struct Device {
    Device(std::size_t number, const typename S::Description& description, Duration world_step);

    bool on = !world::StartsOff<S>;
    bool is_new = false;                // in the step in which it was read
    std::optional<std::uint64_t> step;  // in which it was read last
    world::TimedSensor<S> sensor;
    std::conditional_t<world::HasLine<S>, ReadingLine<typename S::Reading>, NoLine> line;
    genom::Poster<typename S::Reading>* poster = nullptr;
  };
  template <class S>
  using Devices = std::vector<Device<S>>;
  using Exchange = std::function<void(Time date)>;
  struct Row {
    Exchange exchange;
    genom::PosterBase* poster;
    std::optional<Time> taken;  // date of the last command
  };

  /// The part of a row that exchanges do not touch.
  struct Origin {
    const scenario::BridgeRow* scenario;
    std::function<void(genom::PosterBase&)> connect;  // commands only
  };

  /// A device value of this robot, and the function that makes its row.
  struct DeviceValue {
    std::string name;
    std::function<void(Row&)> add;
  };

  void find_device_values();
  Origin& origin(const Row& row) { return origins_[static_cast<std::size_t>(&row - rows_.data())]; }
  void add_row(const scenario::BridgeRow& row);
  void add_base_command(Row& row);
  void add_base_reading(Row& row);
  template <class S>
  void add_device_values(Device<S>& device);
  template <class S>
  void add_reading(Row& row, Device<S>& device);
  void add_pose_of_topic(Row& row);
  template <class T>
  genom::Poster<T>& create_poster(Row& row);
  template <class T, class Take>
  void read_command(Row& row, Take take);
  template <class S>
  Devices<S>& devices() {
    return std::get<Devices<S>>(devices_);
  }
  template <class S>
  bool read(Device<S>& device);
  /// Calls visit(device) for all that have readings on their lines.
  void for_each_busy_line(auto&& visit);
  void expect_scans();
  bool powered();
  void give_arrived(Time now);
  void wait_for_step();
  void find_working_set();

  // Members touched by every exchange come first.
  world::World& world_;
  world::BodyId body_;
  bool has_battery_, takes_poses_ = false;
  world::Battery::Reading battery_;                    // of powered()
  std::optional<posters::PoseOfTopic> pose_of_topic_;  // the newest, for the next exchange
  world::Sensors::Tuple<Devices> devices_;
  std::vector<Row> rows_;
  std::uint64_t step_ = 0;  // number of exchanges
  std::vector<BodyCommand>* command_log_ = nullptr;
  threads::counting_semaphore<> stepped_{0, "world step"};
  const scenario::RobotScenario& robot_;
  genom::NameSpace& names_;
  std::vector<DeviceValue> device_values_;
  std::vector<Origin> origins_;  // by row
  WorkingSet working_set_;
};

}  // namespace waitpoint::bridge
