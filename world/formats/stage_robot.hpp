// SPDX-License-Identifier: BSD-3-Clause
// Stage's `position` as a body: see stage.hpp.
#pragma once

#include "world/description.hpp"
#include "world/formats/left_out.hpp"
#include "world/formats/stage_values.hpp"

namespace waitpoint::world {

/// How many things a file may have, those counted anew that a type brings along.
inline constexpr std::size_t stage_thing_count_max = std::size_t{1} << 20;

/// Reads robots, one after the other.
class StageRobotReader {
 public:
  /// `thing_count` goes up with every thing looked at; BadInput beyond the limit.
  StageRobotReader(LeftOut& left_out, std::size_t& thing_count) : left_out_(left_out), thing_count_(thing_count) {}

  /// The robot that the thing, a `position`, is; without its name.
  BodyDescription read(const StageThing& position);

 private:
  void read_base(const StageThing& position, BaseDescription& base);
  void read_carried(const StageThing& holder, const StageFrame& top, BodyDescription& body);
  void read_ranger(const StageThing& ranger, const StageFrame& frame, BodyDescription& body);
  void read_sensors(const StageThing& ranger, const StageFrame& frame, Duration period,
                    std::vector<LaserDescription>& lasers);
  LaserDescription read_sensor(const StageThing& sensor, const StageFrame& frame, Duration period);
  void count(const StageThing& thing);

  LeftOut& left_out_;
  std::size_t& thing_count_;
};

}  // namespace waitpoint::world
