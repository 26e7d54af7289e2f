// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/stage_robot.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/exact_math.hpp"

namespace waitpoint::world {
namespace {

double radians(double degrees) { return degrees / 180 * exact::pi; }

using Kind = BaseDescription::Kind;

constexpr double steering_max_rad = 0.25 * exact::pi;
constexpr double beams_max = 100000;
constexpr double interval_ms_max = 1e5;

// Combines lasers of one beam each into one laser, if they are at one place with evenly spaced headings, counter-
// clockwise, within a turn.
std::optional<LaserDescription> one_fan(const std::vector<LaserDescription>& lasers) {
  if (lasers.size() < 2) return std::nullopt;
  const LaserDescription& first = lasers.front();
  const double step = exact::wrap_angle(lasers[1].mount.heading - first.mount.heading);
  for (std::size_t i = 0; i < lasers.size(); ++i) {
    const LaserDescription& laser = lasers[i];
    const double off = exact::wrap_angle(laser.mount.heading - first.mount.heading - static_cast<double>(i) * step);
    if (laser.beams != 1 || laser.mount.position() != first.mount.position() || laser.height_m != first.height_m ||
        laser.range_max_m != first.range_max_m || std::fabs(off) > 1e-9) {
      return std::nullopt;
    }
  }
  const double fan = static_cast<double>(lasers.size() - 1) * step;
  if (!(step > 0) || fan >= 2 * exact::pi - 1e-9) return std::nullopt;
  LaserDescription laser = first;
  laser.beams = static_cast<std::uint32_t>(lasers.size());
  laser.field_of_view_rad = fan;
  laser.mount.heading = exact::wrap_angle(first.mount.heading + 0.5 * fan);
  return laser;
}

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
    count(thing);
    if (thing.built_in == "ranger") {
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
  const double interval_ms = stage_number_or(ranger, StageKey::update_interval, 1, interval_ms_max, 100);
  std::vector<LaserDescription> lasers;
  read_sensors(ranger, frame, Duration::from_seconds(1e-3 * interval_ms), lasers);
  if (const std::optional<LaserDescription> fan = one_fan(lasers)) lasers = {*fan};
  body.lasers.insert(body.lasers.end(), lasers.begin(), lasers.end());
  name_lasers(ranger, lasers.size(), robot.origin);
}

void StageRobotReader::name_lasers(const StageThing& ranger, std::size_t count, RobotOrigin& origin) {
  const StageProperty* given = ranger.find(StageKey::name);
  const std::string stem = given != nullptr ? stage_text(*given) : "ranger_" + std::to_string(ranger_count_);
  ++ranger_count_;
  for (std::size_t i = 0; i < count; ++i)
    origin.laser_names.push_back(laser_names_.take(count == 1 ? stem : stem + "_" + std::to_string(i)));
}

void StageRobotReader::read_sensors(const StageThing& ranger, const StageFrame& frame, Duration period,
                                    std::vector<LaserDescription>& lasers) {
  if (ranger.base != nullptr) read_sensors(*ranger.base, frame, period, lasers);
  for (const StageThing& thing : ranger.things) {
    count(thing);
    if (thing.built_in == "sensor") {
      lasers.push_back(read_sensor(thing, frame, period));
    } else {
      left_out_.add(*thing.place.file, thing.place.line, "a ranger's '" + std::string(thing.built_in) + "'",
                    "is left out");
    }
  }
}

LaserDescription StageRobotReader::read_sensor(const StageThing& sensor, const StageFrame& frame, Duration period) {
  LaserDescription laser;
  const StageFrame at = stage_frame(sensor, frame);
  laser.mount = at.pose;
  laser.height_m = at.z_m;
  laser.beams = static_cast<std::uint32_t>(stage_number_or(sensor, StageKey::samples, 1, beams_max, 1));
  laser.field_of_view_rad = radians(stage_number_or(sensor, StageKey::fov, 0, 360, 0));
  // A single beam points straight ahead, for any width of its cone.
  if (laser.beams == 1) laser.field_of_view_rad = 0;
  laser.range_max_m = 5;
  if (const StageProperty* range = sensor.find(StageKey::range)) {
    const std::vector<double> values = stage_numbers(*range, 2, 2);
    if (!(values[1] > 0) || values[0] < 0 || values[0] >= values[1]) {
      refuse(range->place, "expected a range [least most] in metres");
    }
    if (values[0] > 0)
      left_out_.add(*range->place.file, range->place.line, "a sensor's least 'range'", "is taken as 0");
    laser.range_max_m = values[1];
  }
  laser.range_noise_m = 0;
  laser.resolution_m = 0;
  laser.period = period;
  return laser;
}

void StageRobotReader::count(const StageThing& thing) {
  if (++thing_count_ > stage_thing_count_max) {
    refuse(thing.place, "expected at most " + std::to_string(stage_thing_count_max) + " things in the world");
  }
}

}  // namespace waitpoint::world
