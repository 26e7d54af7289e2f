// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/robot_bridge.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/nearest_name.hpp"
#include "modules/scenario/poster_topics.hpp"

namespace waitpoint::bridge {

namespace {

template <class S>
Duration transmission(const typename S::Description& description) {
  if constexpr (world::HasLine<S>) return S::transmission(description);
  return Duration();
}

}  // namespace

template <class S>
RobotBridge::Device<S>::Device(std::size_t number, const typename S::Description& description, Duration world_step)
    : sensor(number, description, world_step), line(transmission<S>(description)) {}

RobotBridge::RobotBridge(const scenario::RobotScenario& robot, world::World& world, world::BodyId body,
                         genom::NameSpace& names)
    : world_(world),
      body_(body),
      has_battery_(robot.body.sensors<world::Battery>().has_value()),
      robot_(robot),
      names_(names) {
  world::Sensors::for_each([&]<class S>() {
    const std::size_t count = robot.body.equipment.count<S>();
    devices<S>().reserve(count);  // rows hold references
    for (std::size_t i = 0; i < count; ++i)
      devices<S>().emplace_back(i, robot.body.equipment.description<S>(i), world.description().step);
  });
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
  if (robot_.nodes)
    device_values_.push_back({std::string(scenario::pose_topic_device), [this](Row& row) { add_pose_of_topic(row); }});
  world::Sensors::for_each([&]<class S>() {
    for (Device<S>& device : devices<S>()) add_device_values(device);
  });
}

template <class S>
void RobotBridge::add_device_values(Device<S>& device) {
  const std::string name = robot_.device_name<S>(device.sensor.number());
  if constexpr (world::HasCommand<S>)
    device_values_.push_back({name + ".command", [this, &device](Row& row) {
                                read_command<typename S::Command>(
                                    row, [&device](const typename S::Command& command) { device.on = command.on; });
                              }});
  device_values_.push_back({name + ".reading", [this, &device](Row& row) { add_reading(row, device); }});
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
    for (Device<world::Sonars>& ring : devices<world::Sonars>()) ring.on = command.sonars_on;
  });
}

void RobotBridge::add_base_reading(Row& row) {
  row.exchange = [this, &poster = create_poster<posters::BaseReading>(row)](Time date) {
    for (Device<world::Sonars>& ring : devices<world::Sonars>()) read(ring);
    if (world::times_due(base_report_period, world_.description().step, step_) == 0) return;
    const world::OdometerReading& odometer = world_.odometer(body_);
    posters::BaseReading reading;
    reading.date = date;
    reading.travel_units = odometer.travel_units;
    reading.turn_units = odometer.turn_units;
    reading.v_m_s = odometer.velocity.v_m_s;
    reading.w_rad_s = odometer.velocity.w_rad_s;
    world_.read<world::Battery>(body_, 0, battery_);
    reading.battery_volts = battery_.volts;
    if (has_battery_) {
      reading.battery_charge = battery_.charge;
      reading.battery_a = battery_.current_a;
    }
    reading.stalled = world_.body(body_).stalled;
    reading.side_units = odometer.side_units;
    reading.height_m = world_.body(body_).height_m;
    for (const Device<world::Sonars>& ring : devices<world::Sonars>())
      if (ring.on)
        for (const double range_m : ring.sensor.reading().range_m) reading.sonar_m.push_back(range_m);
    poster.write(reading);
  };
}

/// Reads the device if it is on and due; true if it has a new reading. The same in all calls of one step.
template <class S>
bool RobotBridge::read(Device<S>& device) {
  if (!device.on) return false;
  if (std::exchange(device.step, step_) != step_) device.is_new = device.sensor.read(world_, body_, step_);
  return device.is_new;
}

template <class S>
void RobotBridge::add_reading(Row& row, Device<S>& device) {
  device.poster = &create_poster<typename S::Reading>(row);
  row.exchange = [this, &device](Time date) {
    if (!read(device)) return;
    typename S::Reading& reading = device.sensor.reading();
    reading.date = date;
    if constexpr (world::HasLine<S>)
      if (device.line.takes_time()) return device.line.send(date, reading);
    device.poster->write(reading);
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
  for (const Device<world::Lasers>& laser : devices<world::Lasers>())
    if (laser.on && laser.poster != nullptr && laser.sensor.is_due(step_) && powered())
      world_.expect_scan(body_, laser.sensor.number(), laser.sensor.reading().number + 1);
}

bool RobotBridge::powered() {
  if (has_battery_) world_.read<world::Battery>(body_, 0, battery_);
  return !battery_.empty;
}

void RobotBridge::for_each_busy_line(auto&& visit) {
  world::Sensors::for_each([&]<class S>() {
    if constexpr (world::HasLine<S>)
      for (Device<S>& device : devices<S>())
        if (!device.line.empty()) visit(device);
  });
}

void RobotBridge::give_arrived(Time now) {
  for_each_busy_line([&]<class S>(Device<S>& device) {
    if (*device.line.next_arrival() > now) return;
    typename S::Reading reading;
    while (device.line.take(now, reading)) device.poster->write(reading);
  });
}

void RobotBridge::wait_for_step() {
  for (;;) {
    std::optional<Time> arrival;
    for_each_busy_line([&](auto& device) {
      const Time next = *device.line.next_arrival();
      if (!arrival || next < *arrival) arrival = next;
    });
    if (!arrival) return stepped_.acquire();
    if (stepped_.try_acquire_for(std::chrono::nanoseconds((*arrival - threads::now()).ns()))) return;
    give_arrived(threads::now());
  }
}

// The memory that exchanges usually touch; of large parts only the beginning.
void RobotBridge::find_working_set() {
  constexpr std::size_t elements_known = 32, of_stack = 512;
  working_set_.add_between(this, &device_values_);
  world::Sensors::for_each([&]<class S>() {
    for (const Device<S>& device : devices<S>())
      if constexpr (world::HasSeveral<S>)
        working_set_.add_between(&device, device.sensor.reading().range_m.begin() + elements_known);
      else
        working_set_.add(device);
  });
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
