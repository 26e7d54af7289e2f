// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/body_reader.hpp"

#include <algorithm>

#include "modules/posters/base.hpp"
#include "modules/scenario/robot_model.hpp"
#include "modules/scenario/sensor_reader.hpp"
#include "modules/scenario/shape_reader.hpp"

namespace waitpoint::scenario {
namespace {

using namespace std::chrono_literals;

using Kind = world::BaseDescription::Kind;

constexpr Kind kinds[] = {Kind::differential, Kind::synchro,    Kind::omni,
                          Kind::ackermann,    Kind::skid_steer, Kind::aerial};

constexpr NumberRange volts{0, 1e5, "a number of volts from 0 to 100000"};
constexpr NumberRange electrical{0, 1e6, "a number from 0 to 1000000"};
constexpr NumberRange battery_number{1e-6, 1e6, "a number from 0.000001 to 1000000"};
constexpr NumberRange battery_range{1e-3, 1e9, "a number of metres from 0.001 to 1e9"};
constexpr NumberRange force{1e-3, 1e9, "a number of newtons from 0.001 to 1e9"};

bool has_two_sides(Kind kind) { return kind == Kind::differential || kind == Kind::skid_steer; }

/// Rejects keys for other kinds of bases, which would have no effect.
void only_for(const YamlMap& map, bool is_such, std::string_view such, std::initializer_list<std::string_view> keys) {
  if (is_such) return;
  for (const std::string_view key : keys)
    if (const YamlNode* node = map.find(key))
      throw node->written.bad("expected no " + std::string(key) + ": it is for a base of kind " + std::string(such));
}

world::OdometryErrors read_odometry(const YamlNode& node, Kind kind) {
  const YamlMap map(
      node, "the odometry",
      {"travel_scale", "turn_scale", "drift_rad_per_m", "travel_noise_m_per_sqrt_m", "turn_noise_rad_per_sqrt_m",
       "turn_noise_rad_per_sqrt_rad", "slips_per_m", "slip_m", "slip_turn_rad", "units_per_m", "units_per_rad",
       "wheel_diameter_ratio", "wheel_base_ratio", "wheel_noise_m_per_sqrt_m", "wheel_ticks_per_m"});
  world::OdometryErrors errors;
  map.read("travel_scale", errors.travel_scale, ranges::factor);
  map.read("turn_scale", errors.turn_scale, ranges::factor);
  map.read("drift_rad_per_m", errors.drift_rad_per_m, ranges::signed_angle_error);
  map.read("travel_noise_m_per_sqrt_m", errors.travel_noise_m_per_sqrt_m, ranges::length_error);
  map.read("turn_noise_rad_per_sqrt_m", errors.turn_noise_rad_per_sqrt_m, ranges::angle_error);
  map.read("turn_noise_rad_per_sqrt_rad", errors.turn_noise_rad_per_sqrt_rad, ranges::angle_error);
  constexpr NumberRange slips{0, 1000, "a number from 0 to 1000"};
  map.read("slips_per_m", errors.slips_per_m, slips);
  map.read("slip_m", errors.slip_m, ranges::length_error);
  map.read("slip_turn_rad", errors.slip_turn_rad, ranges::angle_error);
  map.read("units_per_m", errors.units_per_m, ranges::units);
  map.read("units_per_rad", errors.units_per_rad, ranges::units);
  only_for(map, has_two_sides(kind), "differential or skid_steer",
           {"wheel_diameter_ratio", "wheel_base_ratio", "wheel_noise_m_per_sqrt_m", "wheel_ticks_per_m"});
  map.read("wheel_diameter_ratio", errors.wheel_diameter_ratio, ranges::factor);
  map.read("wheel_base_ratio", errors.wheel_base_ratio, ranges::factor);
  map.read("wheel_noise_m_per_sqrt_m", errors.wheel_noise_m_per_sqrt_m, ranges::length_error);
  map.read("wheel_ticks_per_m", errors.wheel_ticks_per_m, ranges::units);
  return errors;
}

void read_kind(const YamlMap& map, world::BaseDescription& base) {
  const auto otherwise = static_cast<std::size_t>(std::find(std::begin(kinds), std::end(kinds), base.kind) - kinds);
  base.kind =
      kinds[map.one_of("kind", {"differential", "synchro", "omni", "ackermann", "skid_steer", "aerial"}, otherwise)];
  only_for(map, base.kind == Kind::skid_steer, "skid_steer", {"effective_axle_ratio"});
  only_for(map, base.kind == Kind::ackermann, "ackermann", {"wheelbase_m", "steering_max_deg", "steering_rate_deg_s"});
  only_for(map, base.kind == Kind::aerial, "aerial", {"climb_max_m_s", "climb_acceleration_m_s2"});
  constexpr NumberRange longer{1, 1e3, "a number from 1 to 1000"};
  map.read("effective_axle_ratio", base.effective_axle_ratio, longer);
  map.read("wheelbase_m", base.wheelbase_m, ranges::length);
  constexpr NumberRange steering{least_nonzero, 89, "degrees above 0, at most 89"};
  map.read_degrees("steering_max_deg", base.steering_max_rad, steering);
  constexpr NumberRange steering_rate{1e-3, 1e6, "degrees per second from 0.001 to 1000000"};
  map.read_degrees("steering_rate_deg_s", base.steering_rate_rad_s, steering_rate);
  map.read("climb_max_m_s", base.climb_max_m_s, ranges::rate);
  map.read("climb_acceleration_m_s2", base.climb_acceleration_m_s2, ranges::acceleration);
}

world::BaseDescription read_base(const YamlNode& node, world::BaseDescription base) {
  const YamlMap map(node, "the base",
                    {"kind",
                     "v_max_m_s",
                     "w_max_rad_s",
                     "v_acceleration_m_s2",
                     "w_acceleration_rad_s2",
                     "axle_m",
                     "effective_axle_ratio",
                     "wheelbase_m",
                     "steering_max_deg",
                     "steering_rate_deg_s",
                     "climb_max_m_s",
                     "climb_acceleration_m_s2",
                     "mass_kg",
                     "drive_force_n",
                     "grip",
                     "watchdog_ms",
                     "odometry",
                     "battery_volts_full",
                     "battery_volts_empty",
                     "battery_capacity_s",
                     "battery_capacity_m"});
  read_kind(map, base);
  map.read("v_max_m_s", base.v_max_m_s, ranges::rate);
  map.read("w_max_rad_s", base.w_max_rad_s, ranges::rate);
  map.read("v_acceleration_m_s2", base.v_acceleration_m_s2, ranges::acceleration);
  map.read("w_acceleration_rad_s2", base.w_acceleration_rad_s2, ranges::acceleration);
  map.read("mass_kg", base.mass_kg, mass_number);
  map.read("drive_force_n", base.drive_force_n, force);
  map.read("grip", base.grip, friction_number);
  map.read("axle_m", base.axle_m, ranges::length);
  map.read("watchdog_ms", base.watchdog, 1ms);
  if (const YamlNode* odometry = map.find("odometry")) base.odometry = read_odometry(*odometry, base.kind);
  map.read("battery_volts_full", base.battery_volts_full, volts);
  map.read("battery_volts_empty", base.battery_volts_empty, volts);
  map.read("battery_capacity_s", base.battery_capacity_s, ranges::time_constant);
  map.read("battery_capacity_m", base.battery_capacity_m, battery_range);
  return base;
}

/// Rejects the base's own battery keys beside the key `battery`.
void refuse_battery_of_base(const YamlMap& robot) {
  const YamlNode* base = robot.find("base");
  if (base == nullptr) return;
  for (const char* key : {"battery_volts_full", "battery_volts_empty", "battery_capacity_s", "battery_capacity_m"})
    if (const YamlNode* node = base->find(key))
      throw node->written.bad("expected either battery or the base's " + std::string(key));
}

world::BatteryDescription read_battery(const YamlNode& node) {
  const YamlMap map(
      node, "the battery",
      {"volts_full", "volts_empty", "resistance_ohm", "resolution_v", "capacity_ah", "rated_h", "peukert", "charge",
       "off_v", "idle_a", "drive_a_per_m_s", "turn_a_per_rad_s", "climb_a_per_m_s", "stalled_a"});
  world::BatteryDescription battery;
  map.read("volts_full", battery.volts_full, volts);
  map.read("volts_empty", battery.volts_empty, volts);
  if (battery.volts_empty > battery.volts_full) throw node.written.bad("expected volts_empty to be at most volts_full");
  map.read("resistance_ohm", battery.resistance_ohm, electrical);
  map.read("resolution_v", battery.resolution_v, ranges::resolution);
  map.read("capacity_ah", battery.capacity_ah, battery_number);
  map.read("rated_h", battery.rated_h, battery_number);
  constexpr NumberRange exponent{1, 2, "a number from 1 to 2"};
  map.read("peukert", battery.peukert, exponent);
  constexpr NumberRange part{least_nonzero, 1, "a part above 0, at most 1"};
  map.read("charge", battery.charge, part);
  map.read("off_v", battery.off_v, volts);
  map.read("idle_a", battery.idle_a, electrical);
  map.read("drive_a_per_m_s", battery.drive_a_per_m_s, electrical);
  map.read("turn_a_per_rad_s", battery.turn_a_per_rad_s, electrical);
  map.read("climb_a_per_m_s", battery.climb_a_per_m_s, electrical);
  map.read("stalled_a", battery.stalled_a, electrical);
  return battery;
}

}  // namespace

BodyReading read_body(const YamlMap& robot, const BodyReading* given) {
  BodyReading reading;
  if (given != nullptr) reading = *given;
  const std::optional<RobotModel> model = read_robot_model(robot);
  if (model && robot.has("shape")) {
    throw robot.require("urdf").written.bad("expected " + robot.what() + " to have either shape or urdf");
  }
  if (model)
    reading.body.shape = model->robot.shape;
  else if (given == nullptr || robot.has("shape"))
    reading.body.shape = read_body_shape(robot.require("shape"));
  if (model) reading.warnings = model->warnings;
  if (const YamlNode* base = robot.find("base")) reading.body.base = read_base(*base, reading.body.base);
  if (const YamlNode* lasers = robot.find("lasers")) {
    reading.body.lasers.clear();
    reading.laser_names.clear();
    for (const YamlNode& item : read_list(*lasers, "lasers")) {
      LaserReading laser = read_laser(item);
      if (std::count(reading.laser_names.begin(), reading.laser_names.end(), laser.name) > 0) {
        throw item.written.bad("there are two lasers called '" + laser.name + "'");
      }
      mount_at_frame(item, model, laser.laser);
      reading.laser_names.push_back(std::move(laser.name));
      reading.body.lasers.push_back(laser.laser);
    }
  }
  if (const YamlNode* sonars = robot.find("sonars")) {
    std::size_t count = 0;
    for (const YamlNode& item : read_list(*sonars, "sonars")) {
      reading.body.sonars.push_back(read_sonar_ring(item));
      count += reading.body.sonars.back().count;
    }
    if (count > posters::sonar_count_max)
      throw sonars->written.bad("expected " + std::to_string(posters::sonar_count_max) + " sonars at most, found " +
                                std::to_string(count));
  }
  if (const YamlNode* bumpers = robot.find("bumpers")) reading.body.bumpers = read_bumpers(*bumpers);
  if (const YamlNode* infrareds = robot.find("infrareds")) reading.body.infrareds = read_infrareds(*infrareds);
  if (const YamlNode* imu = robot.find("imu")) reading.body.imu = read_imu(*imu);
  if (const YamlNode* gps = robot.find("gps")) reading.body.gps = read_gps(*gps);
  if (const YamlNode* battery = robot.find("battery")) {
    refuse_battery_of_base(robot);
    reading.body.battery = read_battery(*battery);
  }
  return reading;
}

}  // namespace waitpoint::scenario
