// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/body_reader.hpp"

#include <algorithm>

#include "modules/posters/base.hpp"
#include "modules/scenario/keys.hpp"
#include "modules/scenario/robot_model.hpp"
#include "modules/scenario/sensor_reader.hpp"
#include "modules/scenario/shape_reader.hpp"

namespace waitpoint::scenario {
namespace {

using namespace std::chrono_literals;

using Kind = world::BaseDescription::Kind;

constexpr NumberRange volts{0, 1e5, "a number of volts from 0 to 100000"};
constexpr NumberRange electrical{0, 1e6, "a number from 0 to 1000000"};
constexpr NumberRange battery_number{1e-6, 1e6, "a number from 0.000001 to 1000000"};

bool has_two_sides(Kind kind) { return kind == Kind::differential || kind == Kind::skid_steer; }

/// Rejects keys for other kinds of bases, which would have no effect.
void only_for(const YamlMap& map, bool is_such, std::string_view such, std::initializer_list<std::string_view> keys) {
  if (is_such) return;
  for (const std::string_view key : keys)
    if (const YamlNode* node = map.find(key))
      throw node->written.bad("expected no " + std::string(key) + ": it is for a base of kind " + std::string(such));
}

/// The schema's form of only_for(): with one of these keys `kind` is one of the words.
Json needs_kind(std::initializer_list<const char*> keys, std::initializer_list<const char*> kinds) {
  Json given = Json::array(), words = Json::array();
  for (const char* key : keys) given.push_back(needed({key}));
  for (const char* kind : kinds) words.push_back(kind);
  return {{"if", {{"anyOf", given}}},
          {"then", {{"properties", {{"kind", {{"enum", words}}}}}, {"required", {"kind"}}}}};
}

Json wheels_need_sides() {
  const Json of_wheels = {{"anyOf",
                           {needed({"wheel_diameter_ratio"}), needed({"wheel_base_ratio"}),
                            needed({"wheel_noise_m_per_sqrt_m"}), needed({"wheel_ticks_per_m"})}}};
  return {{"if", {{"required", {"odometry"}}, {"properties", {{"odometry", of_wheels}}}}},
          {"then", {{"properties", {{"kind", {{"enum", {"differential", "skid_steer"}}}}}}, {"required", {"kind"}}}}};
}

void check_keys_of_kind(const YamlMap& map, Kind kind) {
  only_for(map, kind == Kind::skid_steer, "skid_steer", {"effective_axle_ratio"});
  only_for(map, kind == Kind::ackermann, "ackermann", {"wheelbase_m", "steering_max_deg", "steering_rate_deg_s"});
  only_for(map, kind == Kind::aerial, "aerial", {"climb_max_m_s", "climb_acceleration_m_s2"});
  const YamlNode* const odometry = map.find("odometry");
  if (odometry == nullptr) return;
  only_for(YamlMap(*odometry, "the odometry", keys_of<world::OdometryErrors>().table().names()), has_two_sides(kind),
           "differential or skid_steer",
           {"wheel_diameter_ratio", "wheel_base_ratio", "wheel_noise_m_per_sqrt_m", "wheel_ticks_per_m"});
}

const Keys<world::BaseDescription>& base_keys() {
  static const Keys<world::BaseDescription> keys =
      Keys<world::BaseDescription>("base")
          .add_fields()
          .add("odometry", &world::BaseDescription::odometry, object_form<world::OdometryErrors>("the odometry"),
               "errors of the odometry")
          .require(wheels_need_sides())
          .require(needs_kind({"effective_axle_ratio"}, {"skid_steer"}))
          .require(needs_kind({"wheelbase_m", "steering_max_deg", "steering_rate_deg_s"}, {"ackermann"}))
          .require(needs_kind({"climb_max_m_s", "climb_acceleration_m_s2"}, {"aerial"}));
  return keys;
}

world::BaseDescription read_base(const YamlNode& node, world::BaseDescription base) {
  if (node.find("odometry") != nullptr) base.odometry = {};
  const YamlMap map(node, "the base", base_keys().table().names());
  base_keys().read(map, base);
  check_keys_of_kind(map, base.kind);
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

Json device_schema(SchemaDefinitions&) { return {{"type", "object"}}; }
Json devices_schema(SchemaDefinitions&) { return list_schema({{"type", "object"}}); }

}  // namespace

const KeyTable& device_keys() {
  static const KeyTable keys =
      KeyTable("devices")
          .add("base", map_of(base_keys().table()), "motion, limits, battery, and the errors of its odometry")
          .add("lasers", devices_schema, "a list of lasers")
          .add("sonars", devices_schema, "a list of rings of sonars")
          .add("bumpers", device_schema, "a ring of bumpers")
          .add("infrareds", device_schema, "a ring of infrared range finders")
          .add("imu", device_schema, "gyro and accelerometers")
          .add("gps", device_schema, "a receiver of positions")
          .add("battery", device_schema, "a battery pack and its loads");
  return keys;
}

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
