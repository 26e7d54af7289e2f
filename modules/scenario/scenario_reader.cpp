// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/scenario_reader.hpp"

#include <algorithm>
#include <chrono>
#include <map>

#include "core/digest.hpp"
#include "core/file_list.hpp"
#include "core/printable_line.hpp"
#include "modules/scenario/control_reader.hpp"
#include "modules/scenario/expectation_reader.hpp"
#include "modules/scenario/log_reader.hpp"
#include "modules/scenario/map_robots.hpp"
#include "modules/scenario/medium_reader.hpp"
#include "modules/scenario/nodes_reader.hpp"
#include "modules/scenario/play_reader.hpp"
#include "modules/scenario/robot_reader.hpp"
#include "modules/scenario/scenario_document.hpp"
#include "modules/scenario/scenario_keys.hpp"
#include "modules/scenario/shape_reader.hpp"
#include "modules/scenario/surface_reader.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {
namespace {

using namespace std::chrono_literals;

constexpr double height_default_m = 2;

void read_map(const YamlNode& node, MapFile& map) {
  const YamlNode* file = &node;
  if (node.kind != YamlNode::Kind::scalar) {
    const YamlMap keys(node, "the map", map_keys().table().names());
    file = &keys.require("file");
    map_keys().read(keys, map);
  }
  map.file = file->written.resolve(read_text(*file, file == &node ? "map" : "file"));
  map.written = file->written;
}

void read_shapes(const YamlNode& list, double height_m, Scenario& scenario) {
  std::map<std::string, Location> names;
  world::LeftOut left_out;
  std::size_t number = 0;
  for (const YamlNode& item : read_list(list, "shapes")) {
    const std::string name = shape_name(item, ++number);
    if (item.find("mesh") != nullptr) {
      scenario.meshes.push_back(read_mesh(item, name, left_out));
      scenario.meshes_written.push_back(item.written);
    } else if (item.find("octomap") != nullptr) {
      for (world::Obstacle& box : read_octomap(item, name, left_out)) scenario.shapes.push_back(std::move(box));
    } else {
      scenario.shapes.push_back(read_obstacle(item, height_m, number));
    }
    scenario.shapes_written.resize(scenario.shapes.size(), item.written);
    const auto [first, is_new] = names.emplace(name, item.written);
    if (!is_new)
      throw item.written.bad("there are two shapes called '" + name + "', the first at " + first->second.text());
  }
  for (std::string& warning : left_out.warnings()) scenario.warnings.push_back(std::move(warning));
}

void read_world(const YamlNode& node, Scenario& scenario) {
  const YamlMap map(node, "the world", world_keys().table().names());
  world_keys().read(map, scenario);
  if (const YamlNode* engine = map.find("engine")) scenario.engine_written = engine->written;
  if (const YamlNode* map_file = map.find("map")) read_map(*map_file, scenario.map.emplace());
  double height_m = height_default_m;
  map.read("shape_height_m", height_m, ranges::length);
  if (const YamlNode* shapes = map.find("shapes")) read_shapes(*shapes, height_m, scenario);
}

void read_robots(const YamlNode& list, const YamlNode* types, Scenario& scenario) {
  if (read_list(list, "robots").empty()) throw list.written.bad("expected at least one robot");
  std::map<std::string, Location> names;
  for (const YamlNode& item : list.items) {
    RobotScenario robot = read_robot(item, types);
    const auto [first, is_new] = names.emplace(robot.name, robot.written);
    if (!is_new)
      throw item.written.bad("there are two robots called '" + robot.name + "', the first at " + first->second.text());
    scenario.robots.push_back(std::move(robot));
  }
}

/// For all robots without one of their own.
void read_common_control(const YamlNode& node, Scenario& scenario) {
  const ControlScenario control = read_control(node);
  for (RobotScenario& robot : scenario.robots)
    if (!robot.control) robot.control = control;
}

void add_rules_to_fingerprint(Scenario& scenario) {
  for (const RobotScenario& robot : scenario.robots) {
    if (!robot.control) continue;
    Digest digest(scenario.fingerprint);
    digest.add(std::string_view(robot.control->rules));
    scenario.fingerprint = digest.value();
  }
}

/// The scenario's name, which stands in a line of every summary.
std::string read_title(const YamlNode& node) {
  constexpr std::ptrdiff_t letters_max = 200;
  std::string title = read_text(node, "name");
  const auto begins_letter = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; };
  const auto letters = std::count_if(title.begin(), title.end(), begins_letter);
  if (letters > letters_max)
    throw node.written.bad("expected name to have at most " + std::to_string(letters_max) + " characters, found " +
                           std::to_string(letters));
  return title;
}

// Scripts and trajectories are part of the scenario that a journal belongs to.
void add_texts(Scenario& scenario) {
  Digest digest;
  for (const RobotScenario& robot : scenario.robots) {
    if (robot.script) digest.add(std::string_view(robot.script->text));
    if (robot.trajectory) digest.add(std::string_view(robot.trajectory->text));
  }
  if (digest.value() == Digest().value()) return;
  digest.add(scenario.fingerprint);
  scenario.fingerprint = digest.value();
}

// Overrides the default of each program.
void read_hosting(const YamlMap& map, Scenario& scenario) {
  const auto hosting = static_cast<Hosting>(map.one_of("hosting", hosting_words, 0));
  for (RobotScenario& robot : scenario.robots)
    for (ProgramScenario& program : robot.programs) program.hosting = hosting;
}

void give_folders_to_scripts(Scenario& scenario, const std::vector<std::string>& allowed) {
  namespace fs = std::filesystem;
  std::vector<std::string> folders = {fs::absolute(scenario.file).parent_path().string()};
  folders.reserve(1 + allowed.size());
  for (const std::string& folder : allowed) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) throw BadInput("--allow", "there is no folder '" + folder + "'");
    folders.push_back(fs::absolute(folder).string());
  }
  const auto is_given = [](const RobotScenario& robot) { return robot.script.has_value(); };
  if (std::none_of(scenario.robots.begin(), scenario.robots.end(), is_given)) return;
  for (const std::string& folder : folders) FileList::add(folder, FileRole::folder);
  for (RobotScenario& robot : scenario.robots)
    if (robot.script) robot.script->folders = folders;
}

}  // namespace

void MapFile::read() {
  if (contents == nullptr)
    contents = std::make_shared<const world::WorldFile>(
        world::read_world_file(file.string(), height_m.value_or(height_default_m)));
}

world::WorldDescription Scenario::world_without_map() const {
  world::WorldDescription world;
  world.step = step;
  world.engine = engine;
  world.obstacles = shapes;
  world.meshes = meshes;
  for (const RobotScenario& robot : robots) world.bodies.push_back(robot.body);
  return world;
}

Scenario read_scenario(const std::filesystem::path& file, const std::vector<std::string>& assignments,
                       const std::vector<std::string>& allowed) {
  const YamlNode document = scenario_document(file, assignments);
  const YamlMap map(document, "the scenario", scenario_keys().names());
  Scenario scenario;
  scenario.file = file.string();
  scenario.fingerprint = fingerprint(document);
  scenario.name = map.has("name") ? read_title(map.require("name")) : printable_line(file.stem().string());
  if (const YamlNode* description = map.find("description"))
    scenario.description = read_lines(*description, "description");
  if (const YamlNode* expect = map.find("expect")) scenario.expect = read_expectation(*expect);
  check_log_is_named(map);
  if (const YamlNode* log = map.find("log")) {
    check_beside_log(map);
    scenario.log = read_log(*log);
    scenario.until = Time::max().since_start();
  }
  if (const YamlNode* play = map.find("play")) {
    scenario.play = read_play(*play);
    scenario.until = Time::max().since_start();
  }
  map.read("until_s", scenario.until, 1s);
  if (const YamlNode* world = map.find("world")) read_world(*world, scenario);
  if (const YamlNode* medium = map.find("medium")) scenario.medium = read_medium(*medium);
  const YamlNode* types = map.find("robot_types");
  const YamlNode* from_map = map.find("robots_from_map");
  if (types != nullptr) {
    if (types->kind != YamlNode::Kind::map) {
      throw types->written.bad("expected robot_types to be a map of keys, found " + described(*types));
    }
    for (const YamlEntry& type : types->entries) check_robot_type(type, from_map != nullptr);
  }
  if (scenario.log)
    scenario.robots.push_back(read_robot_of_log(map.require("robots"), types));
  else if (map.has("robots") || (from_map == nullptr && !scenario.play))
    read_robots(map.require("robots"), types, scenario);
  if (from_map != nullptr) read_robots_from_map(*from_map, types, scenario);
  if (map.has("hosting")) read_hosting(map, scenario);
  if (const YamlNode* control = map.find("control")) read_common_control(*control, scenario);
  if (const YamlNode* ros = map.find("ros")) scenario.ros = read_ros(*ros);
  take_nodes_beside_bag(map, scenario);
  read_nodes(scenario);
  add_rules_to_fingerprint(scenario);
  for (const RobotScenario& robot : scenario.robots)
    if (robot.plan != nullptr) scenario.fingerprint = scenario.fingerprint * 31 + fingerprint(*robot.plan);
  add_texts(scenario);
  give_folders_to_scripts(scenario, allowed);
  return scenario;
}

}  // namespace waitpoint::scenario
