// SPDX-License-Identifier: BSD-3-Clause
// Reads Stage's `position` as a body; see stage.hpp.
#pragma once

#include "world/description.hpp"
#include "world/formats/distinct_names.hpp"
#include "world/formats/left_out.hpp"
#include "world/formats/robot_origin.hpp"
#include "world/formats/stage_ranger.hpp"

namespace waitpoint::world {

struct StageRobot {
  BodyDescription body;  ///< without its name
  RobotOrigin origin;
};

/// Reads robots one by one.
class StageRobotReader {
 public:
  /// Increments `thing_count` for every thing read; BadInput beyond the limit.
  StageRobotReader(LeftOut& left_out, std::size_t& thing_count) : left_out_(left_out), thing_count_(thing_count) {}

  /// The robot of a `position`. Its lasers are named after their rangers: by the ranger's name, else "ranger_0",
  /// "ranger_1", ..., with the suffix "_0", "_1", ... if a ranger has several.
  StageRobot read(const StageThing& position);

 private:
  void read_base(const StageThing& position, BaseDescription& base);
  void read_drive(const StageThing& position, BaseDescription& base);
  void read_steering(const StageThing& position, BaseDescription& base);
  void read_carried(const StageThing& holder, const StageFrame& top, StageRobot& robot);
  void read_ranger(const StageThing& ranger, const StageFrame& frame, StageRobot& robot);
  void name_lasers(const StageThing& ranger, std::size_t count, RobotOrigin& origin);

  LeftOut& left_out_;
  std::size_t& thing_count_;
  std::size_t ranger_count_ = 0;  // of the current robot
  DistinctNames laser_names_;     // likewise
};

}  // namespace waitpoint::world
