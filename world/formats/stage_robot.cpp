// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/stage_robot.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/exact_math.hpp"

namespace waitpoint::world {
namespace {

double radians(double degrees) { return degrees / 180 * exact::pi; }

constexpr double beams_max = 100000;
constexpr double interval_ms_max = 1e5;

// The one laser that lasers of one beam each make, if they stand at one place, their headings evenly spaced, counter-
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

BodyDescription StageRobotReader::read(const StageThing& position) {
  BodyDescription body;
  const StageFrame frame = stage_frame(position, {});
  const StageSize size = stage_size(position);
  body.start = frame.pose;
  body.shape.pose = stage_origin(position);
  body.shape.length_m = size.x_m;
  body.shape.width_m = size.y_m;
  body.shape.z_low_m = frame.z_m;
  body.shape.z_high_m = frame.z_m + size.z_m;
  read_base(position, body.base);
  read_carried(position, {{}, frame.z_m + size.z_m}, body);
  return body;
}

void StageRobotReader::read_base(const StageThing& position, BaseDescription& base) {
  base.kind = BaseDescription::Kind::differential;
  if (const StageProperty* drive = position.find(StageKey::drive); drive != nullptr && stage_text(*drive) != "diff") {
    left_out_.add(*drive->place.file, drive->place.line, "a 'drive' other than \"diff\"", "is taken as that");
  }
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
  };
  bounds(StageKey::velocity_bounds, base.v_max_m_s, base.w_max_rad_s);
  bounds(StageKey::acceleration_bounds, base.v_acceleration_m_s2, base.w_acceleration_rad_s2);
}

void StageRobotReader::read_carried(const StageThing& holder, const StageFrame& top, BodyDescription& body) {
  if (holder.base != nullptr) read_carried(*holder.base, top, body);
  for (const StageThing& thing : holder.things) {
    count(thing);
    if (thing.built_in == "ranger") {
      read_ranger(thing, stage_frame(thing, top), body);
    } else if (thing.built_in == "block") {
      left_out_.add(*thing.place.file, thing.place.line, "a robot's 'block'",
                    "is taken as the box of the robot's size");
    } else {
      left_out_.add(*thing.place.file, thing.place.line, "a robot's '" + std::string(thing.built_in) + "'",
                    "is left out");
    }
  }
}

void StageRobotReader::read_ranger(const StageThing& ranger, const StageFrame& frame, BodyDescription& body) {
  if (ranger.find(StageKey::size) != nullptr)
    body.shape.z_high_m = std::max(body.shape.z_high_m, frame.z_m + stage_size(ranger).z_m);
  const double interval_ms = stage_number_or(ranger, StageKey::update_interval, 1, interval_ms_max, 100);
  std::vector<LaserDescription> lasers;
  read_sensors(ranger, frame, Duration::from_seconds(1e-3 * interval_ms), lasers);
  if (const std::optional<LaserDescription> fan = one_fan(lasers)) lasers = {*fan};
  body.lasers.insert(body.lasers.end(), lasers.begin(), lasers.end());
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
  // A single beam goes straight ahead, however wide the cone that it stands for.
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
