// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/robot_bridge.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/nearest_name.hpp"
#include "modules/scenario/poster_topics.hpp"
#include "world/sensors/laser_timing.hpp"
#include "world/sensors/sonar.hpp"

namespace waitpoint::bridge {

RobotBridge::Laser::Laser(std::size_t n, const world::LaserDescription& d)
    : number(n), period(d.period), line(world::transmission(d)) {
  scan.range_m.resize(d.beams);
}

RobotBridge::RobotBridge(const scenario::RobotScenario& robot, world::World& world, world::BodyId body,
                         genom::NameSpace& names)
    : world_(world),
      body_(body),
      has_battery_(robot.body.sensors<world::Battery>().has_value()),
      robot_(robot),
      names_(names) {
  lasers_.reserve(robot.body.sensors<world::Lasers>().size());  // rows hold references
  for (const world::LaserDescription& laser : robot.body.sensors<world::Lasers>())
    lasers_.emplace_back(lasers_.size(), laser);
  sonar_rings_.resize(robot.body.sensors<world::Sonars>().size());
  find_device_values();
  rows_.reserve(robot.bridge.size());
  for (const scenario::BridgeRow& row : robot.bridge) add_row(row);
}

void RobotBridge::add_row(const scenario::BridgeRow& scenario) {
  for (const Origin& other : origins_)
    if (other.scenario->device == scenario.device)
      throw scenario.written.bad("there are two rows for device '" + scenario.device + "', the first at " +
                                 other.scenario->written.text());
  const auto value = std::find_if(device_values_.begin(), device_values_.end(),
                                  [&](const DeviceValue& known) { return known.name == scenario.device; });
  if (value == device_values_.end()) {
    std::vector<std::string_view> known;
    for (const DeviceValue& each : device_values_) known.push_back(each.name);
    throw scenario.written.bad("this robot has no device value '" + scenario.device + "'" +
                               did_you_mean_or_expected(scenario.device, known));
  }
  rows_.push_back({nullptr, nullptr, std::nullopt});
  origins_.push_back({&scenario, nullptr});
  value->add(rows_.back());
}

void RobotBridge::find_device_values() {
  device_values_ = {{"base.command", [this](Row& row) { add_base_command(row); }},
                    {"base.reading", [this](Row& row) { add_base_reading(row); }}};
  world::SensorsReadAlone::for_each([&]<class S>() {
    if (robot_.body.sensors<S>())
      device_values_.push_back({world::device_value<S>(), [this](Row& row) { add_reading<S>(row); }});
  });
  if (robot_.nodes)
    device_values_.push_back({std::string(scenario::pose_topic_device), [this](Row& row) { add_pose_of_topic(row); }});
  for (std::size_t i = 0; i < lasers_.size(); ++i) {
    Laser& laser = lasers_[i];
    device_values_.push_back(
        {robot_.laser_names[i] + ".command", [this, &laser](Row& row) { add_laser_command(row, laser); }});
    device_values_.push_back(
        {robot_.laser_names[i] + ".reading", [this, &laser](Row& row) { add_laser_reading(row, laser); }});
  }
}

template <class T, class Take>
void RobotBridge::read_command(Row& row, Take take) {
  origin(row).connect = [&row, scenario = origin(row).scenario, take](genom::PosterBase& base) {
    if (dynamic_cast<genom::Poster<T>*>(&base) == nullptr)
      throw scenario->written.bad("poster '" + base.name() + "' has the wrong type for device '" + scenario->device +
                                  "'");
    row.poster = &base;
    row.exchange = [&row, take](Time) {
      T command;
      Time date;
      const auto& poster = static_cast<const genom::Poster<T>&>(*row.poster);
      if (poster.read(command, &date) != genom::PosterStatus::ok || row.taken == date) return;
      row.taken = date;
      take(command);
    };
  };
}

template <class T>
genom::Poster<T>& RobotBridge::create_poster(Row& row) {
  genom::Poster<T>& poster = names_.create_poster<T>(origin(row).scenario->poster, "the bridge");
  poster.set_latency(origin(row).scenario->latency);
  row.poster = &poster;
  return poster;
}

void RobotBridge::add_base_command(Row& row) {
  read_command<posters::BaseCommand>(row, [this](const posters::BaseCommand& command) {
    const world::Velocity velocity{command.v_m_s, command.w_rad_s, command.side_m_s, command.climb_m_s};
    world_.command(body_, velocity);
    if (command_log_ != nullptr) command_log_->push_back({body_, velocity});
    sonars_on_ = command.sonars_on;
  });
}

void RobotBridge::add_base_reading(Row& row) {
  row.exchange = [this, &poster = create_poster<posters::BaseReading>(row)](Time date) {
    if (sonars_on_) fire_sonars();
    if (!due(base_report_period)) return;
    const world::OdometerReading& odometer = world_.odometer(body_);
    posters::BaseReading reading;
    reading.date = date;
    reading.travel_units = odometer.travel_units;
    reading.turn_units = odometer.turn_units;
    reading.v_m_s = odometer.velocity.v_m_s;
    reading.w_rad_s = odometer.velocity.w_rad_s;
    const world::BatteryState battery = world_.battery(body_);
    reading.battery_volts = battery.volts;
    if (robot_.body.sensors<world::Battery>()) {
      reading.battery_charge = battery.charge;
      reading.battery_a = battery.current_a;
    }
    reading.stalled = world_.body(body_).stalled;
    reading.side_units = odometer.side_units;
    reading.height_m = world_.body(body_).height_m;
    if (sonars_on_) {
      for (const SonarRing& ring : sonar_rings_)
        for (const double range : ring.range_m) reading.sonar_m.push_back(range);
    }
    poster.write(reading);
  };
}

// A ring fires when it is switched on and then at its own period, whatever the period of the reports.
void RobotBridge::fire_sonars() {
  for (std::size_t i = 0; i < sonar_rings_.size(); ++i) {
    const world::SonarRingDescription& description = robot_.body.sensors<world::Sonars>()[i];
    SonarRing& ring = sonar_rings_[i];
    const Duration slot = description.period / static_cast<std::int64_t>(world::slots(description));
    const std::int64_t firings = ring.range_m.empty() ? 1 : times_due(slot);
    for (std::int64_t n = 0; n < firings; ++n) world_.sonar(body_, i, ring.firings++, ring.range_m);
  }
}

template <world::ReadAlone S>
void RobotBridge::add_reading(Row& row) {
  row.exchange = [this, &poster = create_poster<typename S::Reading>(row),
                  reading = typename S::Reading()](Time date) mutable {
    if constexpr (world::ReadOnDemand<S>)
      if (!due(S::period(*robot_.body.sensors<S>()))) return;
    if (!world_.read<S>(body_, step_, reading)) return;
    reading.date = date;
    poster.write(reading);
  };
}

bool RobotBridge::take(const posters::PoseOfTopic& pose) {
  if (takes_poses_) pose_of_topic_ = pose;
  return takes_poses_;
}

void RobotBridge::add_pose_of_topic(Row& row) {
  takes_poses_ = true;
  row.exchange = [this, &poster = create_poster<posters::Localisation>(row)](Time) {
    const std::optional<posters::PoseOfTopic> taken = std::exchange(pose_of_topic_, std::nullopt);
    if (!taken) return;
    posters::Localisation localisation;
    localisation.position = {Time() + Duration::from_seconds(taken->date_s), taken->pose, taken->covariance};
    poster.write(localisation);
  };
}

void RobotBridge::add_laser_command(Row& row, Laser& laser) {
  read_command<posters::LaserCommand>(row, [&laser](const posters::LaserCommand& command) { laser.on = command.on; });
}

void RobotBridge::add_laser_reading(Row& row, Laser& laser) {
  laser.poster = &create_poster<posters::LaserReading>(row);
  row.exchange = [this, &laser](Time date) {
    if (!laser.on || !laser.due) return;
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
  for (const Origin& origin : origins_) {
    if (origin.connect == nullptr) continue;
    const scenario::BridgeRow& row = *origin.scenario;
    genom::PosterBase* poster = names_.find_poster(row.poster);
    if (poster == nullptr) {
      std::vector<std::string_view> known;
      for (const auto& [name, entry] : names_.posters()) known.push_back(name);
      throw row.written.bad("no module writes poster '" + row.poster + "'" + did_you_mean(row.poster, known));
    }
    origin.connect(*poster);
    poster->set_latency(row.latency);
  }
}

// Number of multiples of `period` in the step just made; time 0 counts at the start.
std::int64_t RobotBridge::times_due(Duration period) const {
  const Duration step = world_.description().step;
  const Duration now = step * static_cast<std::int64_t>(step_);
  return step_ == 0 ? 1 : now / period - (now - step) / period;
}

void RobotBridge::exchange(Time date) {
  static constexpr std::uint64_t body_state = 0x626F6479;  // "body"
  threads::record(body_state, world_.body(body_));
  give_arrived(date);
  for (const Row& row : rows_)
    if (row.exchange != nullptr && powered()) row.exchange(date);
  ++step_;
  expect_scans();
}

void RobotBridge::expect_scans() {
  for (Laser& laser : lasers_) {
    laser.due = due(laser.period);
    if (laser.on && laser.due && laser.poster != nullptr && powered())
      world_.expect_scan(body_, laser.number, laser.reading.number + 1);
  }
}

bool RobotBridge::powered() const { return !has_battery_ || !world_.battery(body_).empty_at; }

void RobotBridge::give_arrived(Time now) {
  for (Laser& laser : lasers_) {
    if (laser.line.empty() || *laser.line.next_arrival() > now) continue;
    posters::LaserReading reading;
    while (laser.line.take(now, reading)) laser.poster->write(reading);
  }
}

void RobotBridge::wait_for_step() {
  for (;;) {
    std::optional<Time> arrival;
    for (const Laser& laser : lasers_) {
      if (laser.line.empty()) continue;
      const Time next = *laser.line.next_arrival();
      if (!arrival || next < *arrival) arrival = next;
    }
    if (!arrival) return stepped_.acquire();
    if (stepped_.try_acquire_for(std::chrono::nanoseconds((*arrival - threads::now()).ns()))) return;
    give_arrived(threads::now());
  }
}

// The memory that exchanges usually touch; of large parts only the beginning.
void RobotBridge::find_working_set() {
  constexpr std::size_t beams_known = 32, of_stack = 512;
  working_set_.add_between(this, &device_values_);
  for (const Laser& laser : lasers_) {
    const std::size_t beams = std::min(beams_known, laser.scan.range_m.size());
    working_set_.add_between(&laser, laser.reading.range_m.begin() + beams);
    working_set_.add(laser.scan.range_m.data(), beams * sizeof(double));
  }
  working_set_.add(rows_.data(), rows_.size() * sizeof(Row));
  for (const Row& row : rows_) row.poster->add_to(working_set_);
  world_.add_to(working_set_, body_);
  working_set_.add_stack_below(of_stack);
  threads::this_thread::set_working_set(working_set_);
}

void RobotBridge::run() {
  find_working_set();
  for (;;) {
    exchange(threads::now());
    wait_for_step();
  }
}

}  // namespace waitpoint::bridge
