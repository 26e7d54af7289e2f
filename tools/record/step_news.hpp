// SPDX-License-Identifier: BSD-3-Clause
// What a recording takes from a run at one step of the world, independent of the file's format and of the process in
// which a robot's software is.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/pose.hpp"
#include "core/time.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/nodes/shown_topics.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/position.hpp"
#include "tools/record/module_log.hpp"
#include "tools/record/recorded_readings.hpp"

namespace waitpoint::tools {

/// A robot's true pose, and what is new since the step before.
struct RobotNews {
  std::uint32_t robot = 0;
  Pose pose{};
  double height_m = 0;
  std::optional<posters::Odometry> odometry{};
  std::optional<posters::PositionEstimate> position{};
  NewReadings readings{};  ///< of the sensors that a module reads
  std::vector<ModuleLog::Line> lines{};
};

struct StepNews {
  Time now;
  bool is_sampled = false;                               ///< ten times a second
  std::optional<std::vector<world::Shape>> obstacles{};  ///< if they were looked at and have changed
  std::vector<RobotNews> robots{};
  std::vector<nodes::ShownMessage> shown{};  ///< of nodes of ROS, since the step before
};

/// The lines of a robot that no step has taken.
struct RobotLines {
  std::uint32_t robot = 0;
  std::vector<ModuleLog::Line> lines;
};

// Between the processes of a run (modules/run/ranks/archive.hpp).
void carry(auto& archive, ModuleLog::Line& line) { archive(line.date, line.module, line.text, line.is_bad); }
void carry(auto& archive, RobotNews& news) {
  archive(news.robot, news.pose, news.height_m, news.odometry, news.position, news.readings, news.lines);
}
void carry(auto& archive, RobotLines& lines) { archive(lines.robot, lines.lines); }

}  // namespace waitpoint::tools
