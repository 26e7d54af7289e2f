// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/stage_robot.hpp"

#include <algorithm>

#include "core/exact_math.hpp"

namespace waitpoint::world {
namespace {

double radians(double degrees) { return degrees / 180 * exact::pi; }

using Kind = BaseDescription::Kind;

constexpr double steering_max_rad = 0.25 * exact::pi;

}  // namespace

StageRobot StageRobotReader::read(const StageThing& position) {
  StageRobot robot;
  BodyDescription& body = robot.body;
  robot.origin.file = *position.place.file;
  robot.origin.line = position.place.line;
  for (const StageThing* at = position.base; at != nullptr; at = at->base) robot.origin.types.emplace_back(at->type);
  robot.origin.types.emplace_back(position.built_in);
  ranger_count_ = 0;
  laser_names_ = DistinctNames();
  const StageFrame frame = stage_frame(position, {});
  const StageSize size = stage_size(position);
  if (size.z_m == 0) refuse(position.find(StageKey::size)->place, "expected a robot of a positive height");
  body.start = frame.pose;
  body.shape.pose = stage_origin(position);
  body.shape.length_m = size.x_m;
  body.shape.width_m = size.y_m;
  body.shape.z_low_m = frame.z_m;
  body.shape.z_high_m = frame.z_m + size.z_m;
  read_base(position, body.base);
  read_carried(position, {{}, frame.z_m + size.z_m}, robot);
  return robot;
}

void StageRobotReader::read_base(const StageThing& position, BaseDescription& base) {
  read_drive(position, base);
  const auto bounds = [&](StageKey key, double& along, double& about) {
    const StageProperty* property = position.find(key);
    const std::vector<double> values =
        property == nullptr ? std::vector<double>{-1, 1, -1, 1, -1, 1, -90, 90} : stage_numbers(*property, 8, 8);
    along = values[1];
    about = radians(values[7]);
    if (property == nullptr) return;
    if (!(along > 0 && about > 0)) refuse(property->place, "expected positive upper bounds");
    if (values[0] != -values[1] || values[6] != -values[7])
      left_out_.add(*property->place.file, property->place.line, "a lower bound that is not the upper one's opposite",
                    "is left out");
    if (base.kind == Kind::omni && values[3] != values[1])
      left_out_.add(*property->place.file, property->place.line, "a sideways bound of an omni drive",
                    "is taken as that along");
  };
  bounds(StageKey::velocity_bounds, base.v_max_m_s, base.w_max_rad_s);
  bounds(StageKey::acceleration_bounds, base.v_acceleration_m_s2, base.w_acceleration_rad_s2);
  if (base.kind == Kind::ackermann) read_steering(position, base);
}

void StageRobotReader::read_drive(const StageThing& position, BaseDescription& base) {
  base.kind = Kind::differential;
  const StageProperty* drive = position.find(StageKey::drive);
  if (drive == nullptr) return;
  const std::string name = stage_text(*drive);
  if (name == "omni") {
    base.kind = Kind::omni;
  } else if (name == "car") {
    base.kind = Kind::ackermann;
  } else if (name != "diff") {
    left_out_.add(*drive->place.file, drive->place.line, "a 'drive' that is none of \"diff\", \"omni\" and \"car\"",
                  "is taken as \"diff\"");
  }
}

// For a car, the bounds about the vertical are those of the steering angle and its rate.
void StageRobotReader::read_steering(const StageThing& position, BaseDescription& base) {
  base.wheelbase_m = stage_number_or(position, StageKey::wheelbase, 1e-3, 100, 1);
  base.steering_rate_rad_s = base.w_acceleration_rad_s2;
  base.steering_max_rad = std::min(base.w_max_rad_s, steering_max_rad);
  const StageProperty* given = position.find(StageKey::velocity_bounds);
  if (given != nullptr && base.w_max_rad_s > steering_max_rad)
    left_out_.add(*given->place.file, given->place.line, "a car's bound of steering above 45 degrees",
                  "is taken as 45 degrees");
  const auto [s, c] = exact::sincos(base.steering_max_rad);
  base.w_max_rad_s = base.v_max_m_s * s / (c * base.wheelbase_m);
}

void StageRobotReader::read_carried(const StageThing& holder, const StageFrame& top, StageRobot& robot) {
  if (holder.base != nullptr) read_carried(*holder.base, top, robot);
  for (const StageThing& thing : holder.things) {
    count_stage_thing(thing, thing_count_);
    if (thing.built_in == "ranger" || thing.built_in == "laser") {
      read_ranger(thing, stage_frame(thing, top), robot);
    } else if (thing.built_in == "block") {
      left_out_.add(*thing.place.file, thing.place.line, "a robot's 'block'",
                    "is taken as the box of the robot's size");
    } else {
      left_out_.add(*thing.place.file, thing.place.line, "a robot's '" + std::string(thing.built_in) + "'",
                    "is left out");
    }
  }
}

void StageRobotReader::read_ranger(const StageThing& ranger, const StageFrame& frame, StageRobot& robot) {
  BodyDescription& body = robot.body;
  if (ranger.find(StageKey::size) != nullptr)
    body.shape.z_high_m = std::max(body.shape.z_high_m, frame.z_m + stage_size(ranger).z_m);
  const std::vector<LaserDescription> lasers = read_stage_ranger(ranger, frame, left_out_, thing_count_);
  body.sensors<Lasers>().insert(body.sensors<Lasers>().end(), lasers.begin(), lasers.end());
  name_lasers(ranger, lasers.size(), robot.origin);
}

void StageRobotReader::name_lasers(const StageThing& ranger, std::size_t count, RobotOrigin& origin) {
  const StageProperty* given = ranger.find(StageKey::name);
  const std::string stem = given != nullptr ? stage_text(*given) : "ranger_" + std::to_string(ranger_count_);
  ++ranger_count_;
  for (std::size_t i = 0; i < count; ++i)
    origin.laser_names.push_back(laser_names_.take(count == 1 ? stem : stem + "_" + std::to_string(i)));
}

}  // namespace waitpoint::world
