// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/body_reader.hpp"

#include <algorithm>

#include "modules/scenario/keys.hpp"
#include "modules/scenario/robot_model.hpp"
#include "modules/scenario/sensor_reader.hpp"
#include "modules/scenario/shape_reader.hpp"

namespace waitpoint::scenario {
namespace {

using namespace std::chrono_literals;

using Kind = world::BaseDescription::Kind;

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

template <class S>
void read_sensors(const YamlNode& node, const YamlMap& robot, const std::optional<RobotModel>&, BodyReading& reading) {
  static_assert(!world::HasSeveral<S>, "the reading of several sensors of a type needs a rule of its own");
  if constexpr (std::is_same_v<S, world::Battery>) refuse_battery_of_base(robot);
  reading.body.sensors<S>() = read_sensor<S>(node);
}

template <>
void read_sensors<world::Lasers>(const YamlNode& node, const YamlMap&, const std::optional<RobotModel>& model,
                                 BodyReading& reading) {
  reading.body.sensors<world::Lasers>().clear();
  reading.laser_names.clear();
  for (const YamlNode& item : read_list(node, "lasers")) {
    LaserReading laser = read_laser(item);
    if (std::count(reading.laser_names.begin(), reading.laser_names.end(), laser.name) > 0)
      throw item.written.bad("there are two lasers called '" + laser.name + "'");
    mount_at_frame(item, model, laser.laser);
    reading.laser_names.push_back(std::move(laser.name));
    reading.body.sensors<world::Lasers>().push_back(laser.laser);
  }
}

template <>
void read_sensors<world::Sonars>(const YamlNode& node, const YamlMap&, const std::optional<RobotModel>&,
                                 BodyReading& reading) {
  std::size_t count = 0;
  for (const YamlNode& item : read_list(node, "sonars")) {
    reading.body.sensors<world::Sonars>().push_back(read_sensor<world::Sonars>(item));
    count += reading.body.sensors<world::Sonars>().back().count;
  }
  if (count > world::Sonars::count_max)
    throw node.written.bad("expected " + std::to_string(world::Sonars::count_max) + " sonars at most, found " +
                           std::to_string(count));
}

/// The row of a sensor in the table of a robot's keys.
template <class S>
KeyTable::Row sensor_row() {
  const SchemaMaker one = map_of(sensor_keys<S>().table());
  const auto several = [one](SchemaDefinitions& definitions) { return list_schema(one(definitions)); };
  const std::string noun(S::noun);
  if (world::HasSeveral<S>)
    return {std::string(S::key), "a list, each element " + noun, Need::optional, several, nullptr};
  return {std::string(S::key), noun, Need::optional, one, nullptr};
}

}  // namespace

const KeyTable& device_keys() {
  static const KeyTable keys = [] {
    KeyTable all = KeyTable("devices").add("base", map_of(base_keys().table()),
                                           "motion, limits, battery, and the errors of its odometry");
    world::Sensors::for_each([&]<class S>() { all.add_row(sensor_row<S>()); });
    return all;
  }();
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
  world::Sensors::for_each([&]<class S>() {
    if (const YamlNode* node = robot.find(S::key)) read_sensors<S>(*node, robot, model, reading);
  });
  return reading;
}

}  // namespace waitpoint::scenario
