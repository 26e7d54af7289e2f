// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/robot_bridge.hpp"

#include <algorithm>
#include <optional>

#include "core/nearest_name.hpp"
#include "world/sensors/laser_timing.hpp"

namespace waitpoint::bridge {

RobotBridge::Laser::Laser(std::size_t n, const world::LaserDescription& d)
    : number(n), description(&d), line(world::transmission(d)) {}

RobotBridge::RobotBridge(const RobotScenario& robot, world::World& world, world::BodyId body, genom::NameSpace& names)
    : robot_(robot), world_(world), body_(body), names_(names) {
  lasers_.reserve(robot.body.lasers.size());  // rows refer to them
  for (const world::LaserDescription& laser : robot.body.lasers) lasers_.emplace_back(lasers_.size(), laser);
  if (robot.body.sonars.size() > 1) throw robot.written.bad("the base's controller takes one ring of sonars at most");
  rows_.reserve(robot.bridge.size());
  for (const BridgeRow& row : robot.bridge) add_row(row);
}

void RobotBridge::add_row(const BridgeRow& scenario) {
  for (const Row& other : rows_)
    if (other.scenario.device == scenario.device)
      throw scenario.written.bad("device '" + scenario.device + "' is in the table already, at " +
                                 other.scenario.written.text());
  rows_.push_back({scenario, nullptr, nullptr});
  Row& row = rows_.back();
  const std::size_t dot = scenario.device.rfind('.');
  const std::string device = scenario.device.substr(0, dot);
  const std::string value = dot == std::string::npos ? "" : scenario.device.substr(dot + 1);
  const auto laser = std::find(robot_.laser_names.begin(), robot_.laser_names.end(), device);
  if (value == "command" || value == "reading") {
    if (device == "base") return add_base_row(row, value);
    if (laser != robot_.laser_names.end())
      return add_laser_row(row, lasers_[static_cast<std::size_t>(laser - robot_.laser_names.begin())], value);
  }
  std::vector<std::string> known = {"base.command", "base.reading"};
  for (const std::string& name : robot_.laser_names) {
    known.push_back(name + ".command");
    known.push_back(name + ".reading");
  }
  const std::vector<std::string_view> views(known.begin(), known.end());
  throw scenario.written.bad("this robot has no device value '" + scenario.device + "'" +
                             did_you_mean(scenario.device, views));
}

template <class T>
void RobotBridge::read_command(Row& row, std::function<void(const T&)> take) {
  row.connect = [&row, take = std::move(take)](genom::PosterBase& base) {
    auto* poster = dynamic_cast<genom::Poster<T>*>(&base);
    if (poster == nullptr)
      throw row.scenario.written.bad("poster '" + base.name() + "' is not what device '" + row.scenario.device +
                                     "' takes");
    row.exchange = [poster, take, taken = std::optional<Time>()](Time) mutable {
      T command;
      Time date;
      if (poster->read(command, &date) != genom::PosterStatus::ok || taken == date) return;
      taken = date;
      take(command);
    };
  };
}

void RobotBridge::add_base_row(Row& row, const std::string& value) {
  if (value == "command") {
    return read_command<posters::BaseCommand>(row, [this](const posters::BaseCommand& command) {
      world_.command(body_, {command.v_m_s, command.w_rad_s, command.side_m_s, command.climb_m_s});
      sonars_on_ = command.sonars_on;
    });
  }
  auto& poster = names_.create_poster<posters::BaseReading>(row.scenario.poster, "the bridge");
  poster.set_latency(row.scenario.latency);
  row.exchange = [this, &poster](Time date) {
    if (!due(base_report_period)) return;
    const world::OdometerReading& odometer = world_.odometer(body_);
    posters::BaseReading reading;
    reading.date = date;
    reading.travel_units = odometer.travel_units;
    reading.turn_units = odometer.turn_units;
    reading.v_m_s = odometer.velocity.v_m_s;
    reading.w_rad_s = odometer.velocity.w_rad_s;
    reading.battery_volts = world_.battery_volts(body_);
    reading.stalled = world_.body(body_).stalled;
    reading.side_units = odometer.side_units;
    reading.height_m = world_.body(body_).height_m;
    if (sonars_on_ && !robot_.body.sonars.empty()) {
      if (sonar_m_.empty() || due(robot_.body.sonars[0].period)) world_.sonar(body_, 0, step_, sonar_m_);
      for (const double range : sonar_m_) reading.sonar_m.push_back(range);
    }
    poster.write(reading);
  };
}

void RobotBridge::add_laser_row(Row& row, Laser& laser, const std::string& value) {
  if (value == "command") {
    return read_command<posters::LaserCommand>(
        row, [&laser](const posters::LaserCommand& command) { laser.on = command.on; });
  }
  laser.poster = &names_.create_poster<posters::LaserReading>(row.scenario.poster, "the bridge");
  laser.poster->set_latency(row.scenario.latency);
  row.exchange = [this, &laser](Time date) {
    if (!laser.on || !due(laser.description->period)) return;
    posters::LaserReading& reading = laser.reading;
    ++reading.number;
    world_.scan(body_, laser.number, reading.number, laser.scan);
    reading.date = date;
    reading.first_angle_rad = laser.scan.first_angle_rad;
    reading.angle_step_rad = laser.scan.angle_step_rad;
    reading.range_max_m = laser.scan.range_max_m;
    reading.range_m.clear();
    for (const double range : laser.scan.range_m) reading.range_m.push_back(static_cast<float>(range));
    if (laser.line.takes_time())
      laser.line.send(date, reading);
    else
      laser.poster->write(reading);
  };
}

void RobotBridge::connect() {
  for (Row& row : rows_) {
    if (row.connect == nullptr) continue;
    genom::PosterBase* poster = names_.find_poster(row.scenario.poster);
    if (poster == nullptr) {
      std::vector<std::string_view> known;
      for (const auto& [name, entry] : names_.posters()) known.push_back(name);
      throw row.scenario.written.bad("poster '" + row.scenario.poster + "', which no module writes" +
                                     did_you_mean(row.scenario.poster, known));
    }
    row.connect(*poster);
    poster->set_latency(row.scenario.latency);
  }
}

// Whether a multiple of `period` lies in the step just made.
bool RobotBridge::due(Duration period) const {
  const Duration step = world_.description().step;
  const Duration now = step * static_cast<std::int64_t>(step_);
  return step_ == 0 || now / period > (now - step) / period;
}

void RobotBridge::exchange(Time date) {
  static constexpr std::uint64_t body_state = 0x626F6479;  // "body"
  threads::record(body_state, world_.body(body_));
  give_arrived(date);
  for (const Row& row : rows_)
    if (row.exchange != nullptr) row.exchange(date);
  ++step_;
}

void RobotBridge::give_arrived(Time now) {
  posters::LaserReading reading;
  for (Laser& laser : lasers_) {
    while (laser.line.take(now, reading)) laser.poster->write(reading);
  }
}

void RobotBridge::wait_for_step() {
  for (;;) {
    std::optional<Time> arrival;
    for (const Laser& laser : lasers_) {
      const std::optional<Time> next = laser.line.next_arrival();
      if (next && (!arrival || *next < *arrival)) arrival = next;
    }
    if (!arrival) return stepped_.acquire();
    if (stepped_.try_acquire_for(std::chrono::nanoseconds((*arrival - threads::now()).ns()))) return;
    give_arrived(threads::now());
  }
}

void RobotBridge::run() {
  for (;;) {
    exchange(threads::now());
    wait_for_step();
  }
}

}  // namespace waitpoint::bridge
