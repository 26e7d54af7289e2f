// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/log_reader.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/confinement.hpp"
#include "core/number_text.hpp"
#include "modules/scenario/robot_reader.hpp"
#include "modules/scenario/shape_reader.hpp"

namespace waitpoint::scenario {
namespace {

using Names = std::initializer_list<std::string_view>;

/// Throws at the first key of `map` that has a value and is not among `good`.
void check_keys(const YamlNode& map, const Names& good, const std::string& reason) {
  for (const YamlEntry& entry : map.entries)
    if (!entry.value.is_null() && std::find(good.begin(), good.end(), entry.key) == good.end())
      throw entry.written.bad("expected no '" + entry.key + "' " + reason);
}

std::filesystem::path read_file(const YamlNode& node) {
  std::filesystem::path file = node.written.resolve(read_text(node, "log"));
  if (!Confinement::allows(file))
    throw node.written.bad("'" + file.string() + "' lies outside of the folders that --confined allows");
  return file;
}

/// What a key of the log chooses among its records; `place`, for messages, is the key's, or the log's.
void read_choice(const YamlNode& log, const char* key, std::string& name, std::string& place) {
  const YamlNode* const value = log.find(key);
  place = (value != nullptr ? *value : log).written.text() + ": " + key;
  if (value != nullptr) name = read_text(*value, key);
}

}  // namespace

const Keys<logs::GivenLaser>& log_keys() {
  using Laser = logs::GivenLaser;
  static const Keys<Laser> keys =
      Keys<Laser>("log")
          .add("file", text_form().schema, "CARMEN, GMapping, ROS 1 bag or MCAP, also compressed by gzip",
               Need::required)
          .add("scan", text_form().schema, "what to take of a log that has several, as of `waitpoint play`")
          .add("odometry", text_form().schema, "the same")
          .add("robot", text_form().schema, "the same")
          .add("field_of_view_deg", &Laser::field_of_view_rad,
               optional_form(degrees_form({0.1, 360, "an angle from 0.1 to 360"})),
               "from the first beam to the last, half on either side of the laser's axis; without it of the log")
          .add("mount", &Laser::mount, optional_form(pose_form()),
               "`[x, y, heading_deg]` of the laser on the robot; without it of the log")
          .add("range_max_m", &Laser::range_max_m, optional_form(number_form(ranges::length)),
               "readings from here on are no echoes; without it of the log");
  return keys;
}

LogFile read_log(const YamlNode& node) {
  LogFile log;
  log.written = node.written;
  read_choice(node, "scan", log.choice.scan, log.choice.scan_place);
  read_choice(node, "odometry", log.choice.odometry, log.choice.odometry_place);
  read_choice(node, "robot", log.choice.robot, log.choice.robot_place);
  if (node.kind == YamlNode::Kind::scalar) {
    log.file = read_file(node);
    return log;
  }
  const YamlMap map(node, "the log", log_keys().table().names());
  log.file = read_file(map.require("file"));
  log_keys().read(map, log.laser);
  return log;
}

void check_log_is_named(const YamlMap& scenario) {
  for (const YamlEntry& entry : scenario.node().entries)
    if (entry.key == "log" && entry.value.is_null() && !scenario.has("world"))
      throw entry.written.bad("expected the name of a log, found nothing");
}

void check_beside_log(const YamlMap& scenario) {
  check_keys(scenario.node(), {"format", "name", "description", "until_s", "log", "robot_types", "robots"},
             "beside a log, which is in place of a world");
}

RobotScenario read_robot_of_log(const YamlNode& list, const YamlNode* types) {
  const std::vector<YamlNode>& robots = read_list(list, "robots");
  if (robots.size() != 1)
    throw(robots.empty() ? list : robots[1])
        .written.bad("expected one robot, whose modules the log drives, found " + std::to_string(robots.size()));
  const YamlNode& node = robots.front();
  check_keys(node, {"name", "type", "modules", "bridge", "processors"}, "in a robot whose modules a log drives");
  RobotScenario robot = read_robot_without_body(node, types);
  // Nothing commands the modules.
  robot.programs.clear();
  robot.nodes.reset();
  robot.control.reset();
  robot.script.reset();
  return robot;
}

}  // namespace waitpoint::scenario
