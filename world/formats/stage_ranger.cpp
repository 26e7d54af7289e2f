// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/stage_ranger.hpp"

#include <cmath>
#include <optional>
#include <string>

#include "core/exact_math.hpp"

namespace waitpoint::world {
namespace {

constexpr double beams_max = 100000;
constexpr double transducers_max = 1000;
constexpr double interval_ms_max = 1e5;
// Defaults of Stage's versions.
constexpr double sensor_range_m = 5, old_laser_range_m = 8, old_laser_fov_deg = 180, old_laser_samples = 180;

double radians(double degrees) { return degrees / 180 * exact::pi; }

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

class RangerReader {
 public:
  RangerReader(const StageThing& ranger, LeftOut& left_out, std::size_t& thing_count)
      : ranger_(ranger), left_out_(left_out), thing_count_(thing_count) {
    const double interval_ms = stage_number_or(ranger, StageKey::update_interval, 1, interval_ms_max, 100);
    period_ = Duration::from_seconds(1e-3 * interval_ms);
  }

  std::vector<LaserDescription> read(const StageFrame& frame) {
    if (ranger_.built_in == "laser") {
      read_old_laser(frame);
    } else {
      read_sensors(ranger_, frame);
      read_transducers(frame);
    }
    if (const std::optional<LaserDescription> fan = one_fan(lasers_)) lasers_ = {*fan};
    return std::move(lasers_);
  }

 private:
  LaserDescription laser_at(const StageFrame& frame, double range_m) const {
    LaserDescription laser;
    laser.mount = frame.pose;
    laser.height_m = frame.z_m;
    laser.beams = 1;
    laser.field_of_view_rad = 0;  // a single beam points straight ahead, for any width of its cone
    laser.range_max_m = range_m;
    laser.range_noise_m = 0;
    laser.resolution_m = 0;
    laser.period = period_;
    return laser;
  }

  static void spread(LaserDescription& laser, const StageThing& thing, double samples, double fov_deg) {
    laser.beams = static_cast<std::uint32_t>(stage_number_or(thing, StageKey::samples, 1, beams_max, samples));
    if (laser.beams > 1) laser.field_of_view_rad = radians(stage_number_or(thing, StageKey::fov, 0, 360, fov_deg));
  }

  void read_sensors(const StageThing& ranger, const StageFrame& frame) {
    if (ranger.base != nullptr) read_sensors(*ranger.base, frame);
    for (const StageThing& thing : ranger.things) {
      count_stage_thing(thing, thing_count_);
      if (thing.built_in == "sensor") {
        const StageProperty* range = thing.find(StageKey::range);
        LaserDescription laser = laser_at(stage_frame(thing, frame), sensor_range_m);
        if (range != nullptr) laser.range_max_m = greatest_range_m(*range, 2);
        spread(laser, thing, 1, 0);
        lasers_.push_back(laser);
      } else {
        left_out_.add(*thing.place.file, thing.place.line, "a ranger's '" + std::string(thing.built_in) + "'",
                      "is left out");
      }
    }
  }

  void read_transducers(const StageFrame& frame) {
    const double count = stage_number_or(ranger_, StageKey::scount, 0, transducers_max, 0);
    const StageProperty* view = ranger_.find(StageKey::sview);
    for (std::size_t i = 0; static_cast<double>(i) < count; ++i) {
      const std::string index = "[" + std::to_string(i) + "]";
      const StageProperty* pose = ranger_.find_named("spose" + index);
      if (pose == nullptr) refuse(ranger_.place, "expected spose" + index + " in a ranger of that 'scount'");
      const std::vector<double> p = stage_numbers(*pose, 3, 3);
      const StageProperty* own = ranger_.find_named("sview" + index);
      if (own == nullptr) own = view;
      const double range_m = own == nullptr ? sensor_range_m : greatest_range_m(*own, 3);
      const Pose at = {p[0], p[1], exact::wrap_angle(radians(p[2]))};
      lasers_.push_back(laser_at({compose(frame.pose, at), frame.z_m}, range_m));
    }
  }

  void read_old_laser(const StageFrame& frame) {
    const double range_m = stage_number_or(ranger_, StageKey::range_max, 1e-3, 1e5, old_laser_range_m);
    if (stage_number_or(ranger_, StageKey::range_min, 0, 1e5, 0) > 0) tell_least(*ranger_.find(StageKey::range_min));
    LaserDescription laser = laser_at(frame, range_m);
    spread(laser, ranger_, old_laser_samples, old_laser_fov_deg);
    lasers_.push_back(laser);
  }

  // Of "[least most ...]", with `size` numbers.
  double greatest_range_m(const StageProperty& range, std::size_t size) {
    const std::vector<double> values = stage_numbers(range, size, size);
    if (!(values[1] > 0) || values[0] < 0 || values[0] >= values[1]) {
      refuse(range.place, "expected a range [least most] in metres");
    }
    if (values[0] > 0) tell_least(range);
    return values[1];
  }

  void tell_least(const StageProperty& range) {
    left_out_.add(*range.place.file, range.place.line, "a sensor's least 'range'", "is taken as 0");
  }

  const StageThing& ranger_;
  LeftOut& left_out_;
  std::size_t& thing_count_;
  Duration period_;
  std::vector<LaserDescription> lasers_;
};

}  // namespace

void count_stage_thing(const StageThing& thing, std::size_t& thing_count) {
  if (++thing_count > stage_thing_count_max) {
    refuse(thing.place, "expected at most " + std::to_string(stage_thing_count_max) + " things in the world");
  }
}

std::vector<LaserDescription> read_stage_ranger(const StageThing& ranger, const StageFrame& frame, LeftOut& left_out,
                                                std::size_t& thing_count) {
  return RangerReader(ranger, left_out, thing_count).read(frame);
}

}  // namespace waitpoint::world
