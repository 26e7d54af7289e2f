// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/robot_reader.hpp"

#include <algorithm>

#include "core/confinement.hpp"
#include "core/file_contents.hpp"
#include "core/nearest_name.hpp"
#include "modules/scenario/body_reader.hpp"
#include "modules/scenario/command_reader.hpp"
#include "modules/scenario/control_reader.hpp"
#include "modules/scenario/nodes_reader.hpp"
#include "modules/scenario/robot_keys.hpp"
#include "modules/scenario/shape_reader.hpp"
#include "modules/scenario/yaml_override.hpp"

namespace waitpoint::scenario {
namespace {

constexpr std::size_t letters_max = 40;  // the kernel stores names in fixed arrays

bool is_reserved(const std::string& name) { return name == "environment" || name == "base"; }

bool fits_names(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

/// Names are part of --set paths, poster names and file names, hence the restrictions.
std::string read_name(const YamlNode& node, std::string_view what) {
  std::string name = read_text(node, what);
  if (!std::all_of(name.begin(), name.end(), fits_names)) {
    throw node.written.bad("expected " + std::string(what) + " to be of letters, digits, '_' and '-', found '" + name +
                           "'");
  }
  if (name.size() > letters_max || is_reserved(name))
    throw node.written.bad("expected " + std::string(what) + " to have at most " + std::to_string(letters_max) +
                           " letters and not to be 'environment' or 'base', found '" + name + "'");
  return name;
}

bool is_setting(const std::string& key) { return key != "name" && key != "type" && key != "enabled"; }

std::vector<ModuleScenario> read_modules(const YamlNode& node) {
  std::vector<ModuleScenario> modules;
  for (const YamlNode& item : read_list(node, "modules")) {
    if (item.kind != YamlNode::Kind::map)
      throw item.written.bad("expected a module with a name, found " + described(item));
    const YamlNode* name = item.find("name");
    if (name == nullptr) throw item.written.bad("expected key 'name' in a module");
    ModuleScenario module;
    module.written = item.written;
    module.name = read_name(*name, "the name of a module");
    const YamlNode* type = item.find("type");
    module.type = type == nullptr ? module.name : read_name(*type, "type");
    if (const YamlNode* enabled = item.find("enabled")) module.enabled = read_truth(*enabled, "enabled");
    for (const ModuleScenario& other : modules) {
      if (other.name != module.name) continue;
      throw item.written.bad("there are two modules called '" + module.name + "', the first at " +
                             other.written.text());
    }
    for (const YamlEntry& entry : item.entries) {
      if (!is_setting(entry.key)) continue;
      for (Setting& setting : flattened(entry.value, entry.key)) module.settings.push_back(std::move(setting));
    }
    modules.push_back(std::move(module));
  }
  return modules;
}

std::string read_dotted(const YamlMap& row, std::string_view key) {
  std::string text = row.text(key);
  const std::size_t dot = text.find('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == text.size()) {
    throw row.require(key).written.bad("expected " + std::string(key) + " to be two names joined by a dot, found '" +
                                       text + "'");
  }
  return text;
}

std::vector<BridgeRow> read_bridge(const YamlNode& node) {
  std::vector<BridgeRow> rows;
  for (const YamlNode& item : read_list(node, "bridge")) {
    const YamlMap map(item, "a row of the bridge", bridge_row_keys().names());
    BridgeRow row{read_dotted(map, "poster"), read_dotted(map, "device"), Duration(), item.written};
    constexpr NumberRange latency{0, 3.6e9, "a number from 0 to 3600000000"};
    if (map.has("latency_us")) row.latency = Duration::from_seconds(map.number("latency_us", latency) * 1e-6);
    for (const BridgeRow& other : rows) {
      const bool twice = other.poster == row.poster || other.device == row.device;
      if (!twice) continue;
      throw item.written.bad("'" + (other.poster == row.poster ? row.poster : row.device) +
                             "' is in the bridge's table twice, first at " + other.written.text());
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<std::string> read_processors(const YamlNode& node) {
  std::vector<std::string> names;
  for (const YamlNode& item : read_list(node, "processors")) {
    names.push_back(read_name(item, "the name of a processor"));
    if (std::find(names.begin(), names.end() - 1, names.back()) != names.end() - 1)
      throw item.written.bad("there are two processors called '" + names.back() + "'");
  }
  return names;
}

std::vector<StartCondition> read_conditions(const YamlNode& node) {
  std::vector<StartCondition> conditions;
  for (const YamlNode& item : read_list(node, "after")) {
    const std::string text = read_lines(item, "a condition");
    if (!parse(text, conditions.emplace_back()))
      throw item.written.bad("expected NAME, NAME.started, tcp:PORT or a path with a '/' in after, got '" + text + "'");
  }
  return conditions;
}

// Those on other programs must be of enabled ones of the robot, and without cycles.
void check_conditions(const std::vector<ProgramScenario>& programs) {
  std::vector<ConditionedStart> starts;
  starts.reserve(programs.size());
  for (const ProgramScenario& program : programs) starts.push_back({program.name, program.after});
  waitpoint::check_conditions(starts, [&](std::size_t refused, const StartCondition* unknown) {
    const ProgramScenario& program = programs[refused];
    throw program.written.bad(unknown != nullptr
                                  ? "after: the robot has no program '" + unknown->of + "'"
                                  : "'" + program.name + "' can never start: the conditions in after form a cycle");
  });
}

std::vector<ProgramScenario> read_programs(const YamlNode& node) {
  std::vector<ProgramScenario> programs;
  for (const YamlNode& item : read_list(node, "programs")) {
    const YamlMap map(item, "a program", program_keys().names());
    ProgramScenario program;
    program.written = item.written;
    program.name = read_name(map.require("name"), "the name of a program");
    if (Confinement::exists()) throw item.written.bad("programs are not loaded with --confined");
    if (const YamlNode* command = map.find("command")) {
      program.words = read_command(*command);
      if (map.find("file") != nullptr || map.find("arguments") != nullptr)
        throw item.written.bad("expected a file with arguments, or a command, in a program, got both");
    } else {
      const YamlNode& file = map.require("file");
      program.words = {file.written.resolve(read_text(file, "file"))};
      program.is_shared_object = true;
      program.hosting = Hosting::in_process;
    }
    if (const YamlNode* arguments = map.find("arguments"))
      for (const YamlNode& argument : read_list(*arguments, "arguments"))
        program.words.push_back(read_lines(argument, "an argument"));
    if (const YamlNode* after = map.find("after")) program.after = read_conditions(*after);
    for (const ProgramScenario& other : programs)
      if (other.name == program.name)
        throw item.written.bad("there are two programs called '" + program.name + "', the first at " +
                               other.written.text());
    bool enabled = true;
    map.read("enabled", enabled);
    if (enabled) programs.push_back(std::move(program));
  }
  check_conditions(programs);
  return programs;
}

ScriptScenario read_script(const YamlNode& node) {
  constexpr std::size_t bytes_max = 1 << 20;
  if (Confinement::exists()) throw node.written.bad("scripts are not executed with --confined");
  ScriptScenario script;
  script.file = node.written.resolve(read_text(node, "tcl")).string();
  script.text = file_contents(script.file, "a script in Tcl", bytes_max);
  script.written = node.written;
  return script;
}

TrajectoryScenario read_trajectory(const YamlNode& node) {
  constexpr std::size_t bytes_max = 256 << 20;
  TrajectoryScenario trajectory;
  trajectory.file = node.written.resolve(read_text(node, "trajectory")).string();
  trajectory.text = file_contents(trajectory.file, "a trajectory", bytes_max);
  trajectory.written = node.written;
  return trajectory;
}

std::vector<Goal> read_goals(const YamlNode& node) {
  std::vector<Goal> goals;
  for (const YamlNode& item : read_list(node, "goals")) {
    Goal goal;
    goal.written = item.written;
    if (item.kind == YamlNode::Kind::map) {
      const YamlMap map(item, "a goal", goal_keys().names());
      goal.position.x = map.number("x_m", ranges::coordinate);
      goal.position.y = map.number("y_m", ranges::coordinate);
      goal.name = map.text("name", "");
    } else {
      goal.position = read_point(item, "a goal");
    }
    goals.push_back(std::move(goal));
  }
  return goals;
}

/// The document of a plan's file.
std::shared_ptr<const YamlNode> read_plan_document(const YamlNode& node) {
  const std::filesystem::path file = node.written.resolve(read_text(node, "plan"));
  if (!Confinement::allows(file))
    throw node.written.bad("'" + file.string() + "' lies outside of the folders that --confined allows");
  if (!std::filesystem::is_regular_file(file))
    throw node.written.bad("expected the file of a plan, found '" + file.string() + "', which is no regular file");
  return std::make_shared<const YamlNode>(load_yaml(file));
}

/// An element of `robots`, alone or laid over its type.
YamlMap map_of_robot(const YamlNode& node) {
  return YamlMap(node, name_of(node).empty() ? "a robot" : "robot '" + std::string(name_of(node)) + "'",
                 robot_keys().names());
}

/// The keys of a robot type: all but name, start and goals.
RobotScenario read_equipment(const YamlMap& map, const BodyReading* given = nullptr) {
  RobotScenario robot;
  BodyReading reading = read_body(map, given);
  robot.body = std::move(reading.body);
  robot.laser_names = std::move(reading.laser_names);
  robot.warnings = std::move(reading.warnings);
  if (const YamlNode* modules = map.find("modules")) robot.modules = read_modules(*modules);
  if (const YamlNode* bridge = map.find("bridge")) robot.bridge = read_bridge(*bridge);
  if (const YamlNode* programs = map.find("programs")) robot.programs = read_programs(*programs);
  if (const YamlNode* processors = map.find("processors")) robot.processors = read_processors(*processors);
  if (const YamlNode* executive = map.find("executive")) {
    if (executive->kind != YamlNode::Kind::map) {
      throw executive->written.bad("expected executive to be a map of keys, found " + described(*executive));
    }
    for (Setting& setting : flattened(*executive))
      if (setting.key != "tcl") robot.executive.push_back(std::move(setting));
    if (const YamlNode* script = executive->find("tcl")) robot.script = read_script(*script);
  }
  if (const YamlNode* control = map.find("control")) robot.control = read_control(*control);
  robot.nodes = take_nodes(map);
  return robot;
}

const YamlNode& type_of(const YamlMap& robot, const YamlNode* types) {
  const YamlNode& node = robot.require("type");
  const std::string name = read_text(node, "type");
  if (const YamlNode* type = types == nullptr ? nullptr : types->find(name)) return *type;
  std::vector<std::string_view> names;
  if (types != nullptr) {
    for (const YamlEntry& entry : types->entries) names.push_back(entry.key);
  }
  throw node.written.bad("there is no robot type '" + name + "'" + did_you_mean_or_expected(name, names));
}

}  // namespace

RobotScenario read_robot(const YamlNode& node, const YamlNode* types) {
  const YamlMap own = map_of_robot(node);
  const std::string name = read_name(own.require("name"), "the name of a robot");
  const YamlNode whole = own.has("type") ? laid_over(type_of(own, types), node) : node;
  RobotScenario robot = read_equipment(map_of_robot(whole));
  robot.name = name;
  robot.written = node.written;
  robot.body.name = name;
  const YamlNode& start = own.require("start");
  robot.body.start = read_pose(start, "start");
  robot.start_written = start.written;
  if (const YamlNode* height = own.find("start_height_m")) {
    if (robot.body.base.kind != world::BaseDescription::Kind::aerial)
      throw height->written.bad("expected no start_height_m: " + own.what() + " does not fly");
    own.read("start_height_m", robot.body.start_height_m, ranges::height);
  }
  if (const YamlNode* goals = own.find("goals")) robot.goals = read_goals(*goals);
  if (const YamlNode* plan = own.find("plan")) {
    if (!robot.goals.empty()) throw plan->written.bad("expected goals or a plan, found both in " + own.what());
    robot.plan = read_plan_document(*plan);
  }
  if (const YamlNode* trajectory = own.find("trajectory")) {
    if (!robot.goals.empty() || robot.plan != nullptr || robot.script)
      throw trajectory->written.bad("expected a trajectory without goals, plan and script, found one of them in " +
                                    own.what());
    robot.trajectory = read_trajectory(*trajectory);
  }
  return robot;
}

RobotScenario read_robot_without_body(const YamlNode& node, const YamlNode* types) {
  const YamlMap own = map_of_robot(node);
  const YamlNode whole = own.has("type") ? laid_over(type_of(own, types), node) : node;
  BodyReading given;
  given.body.sensors<world::Lasers>().emplace_back();
  given.laser_names = {"laser"};
  RobotScenario robot = read_equipment(map_of_robot(whole), &given);
  robot.name = robot.body.name = read_name(own.require("name"), "the name of a robot");
  robot.written = node.written;
  return robot;
}

RobotScenario read_robot_of_map(const YamlNode& node, const YamlNode* types, const std::string& name,
                                const BodyReading& given) {
  const std::string title = "robot '" + name + "' of the map";
  const std::span<const std::string_view> keys = robot_of_map_keys().names();
  const YamlMap own(node, title, keys);
  const YamlNode whole = own.has("type") ? laid_over(type_of(own, types), node) : node;
  RobotScenario robot = read_equipment(YamlMap(whole, title, keys), &given);
  robot.name = robot.body.name = name;
  robot.written = node.written;
  if (const YamlNode* goals = own.find("goals")) robot.goals = read_goals(*goals);
  return robot;
}

std::string fitting_name(const std::string& name) {
  constexpr std::size_t number_letters = 8;  // of the suffix that makes it unique
  std::string fitting = name.substr(0, letters_max - number_letters);
  for (char& c : fitting)
    if (!fits_names(c)) c = '_';
  return is_reserved(fitting) ? fitting + "_" : fitting;
}

void check_robot_type(const YamlEntry& type, bool for_map) {
  const BodyReading of_map;
  read_equipment(YamlMap(type.value, "robot type '" + type.key + "'", robot_type_keys().names()),
                 for_map ? &of_map : nullptr);
}

}  // namespace waitpoint::scenario
