// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/nodes_reader.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <span>

#include "core/confinement.hpp"
#include "modules/ros1/graph_name.hpp"
#include "modules/ros1/launch_file.hpp"
#include "modules/ros1/substitution.hpp"
#include "modules/scenario/command_reader.hpp"
#include "modules/scenario/nodes_keys.hpp"
#include "modules/scenario/parameter_value.hpp"
#include "modules/scenario/poster_topics.hpp"

namespace waitpoint::scenario {
namespace {

constexpr std::string_view keys_of_robot[] = {"ros", "launch", "nodes"};
constexpr std::string_view keys_beside_bag[] = {"launch", "nodes"};

ros1::LaunchSurroundings surroundings_of_process() {
  const auto environment = [](const std::string& name) -> std::optional<std::string> {
    const char* const value = std::getenv(name.c_str());
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
  };
  return {ros1::Packages::of(environment), environment,
          [](const std::string& text, const std::string& file) { return parameter_value(parse_yaml(text, file)); }};
}

std::string name_in_graph(const YamlNode& node, const std::string& name, const std::string& what) {
  if (!ros1::is_graph_name(name))
    throw node.written.bad("expected " + what + " to be a name of ROS: letters, digits, '_' and '/', found '" + name +
                           "'");
  return name;
}

// A key without a value is no key, so the elements of a map are its entries with values.
template <class Take>
void for_each_text(const YamlMap& holder, std::string_view key, const Take& take) {
  const YamlNode* const map = holder.find(key);
  if (map == nullptr) return;
  if (map->kind != YamlNode::Kind::map)
    throw map->written.bad("expected " + std::string(key) + " to be a map of names and texts, found " +
                           described(*map));
  for (const YamlEntry& entry : map->entries)
    if (!entry.value.is_null()) take(entry, read_lines(entry.value, "'" + entry.key + "' in " + std::string(key)));
}

void read_program(const YamlMap& map, ros1::Node& node) {
  const YamlNode* const command = map.find("command");
  if (command != nullptr && (map.has("package") || map.has("type")))
    throw map.node().written.bad("expected a command, or a package and a type, in a node, found both");
  if (command != nullptr) {
    node.command = read_command(*command);
  } else {
    if (!map.has("package"))
      throw map.node().written.bad("expected a command, or a package and a type, in a node, found none");
    node.package = map.text("package");
    node.type = map.text("type");
  }
  if (const YamlNode* arguments = map.find("arguments"))
    for (const YamlNode& argument : read_list(*arguments, "arguments"))
      node.arguments.push_back(read_lines(argument, "an argument"));
}

void read_conditions_of_node(const YamlNode& list, ros1::Node& node) {
  for (const YamlNode& item : read_list(list, "after")) {
    const std::string text = read_lines(item, "a condition");
    if (!ros1::parse(text, node.ns, node.after.emplace_back()))
      throw item.written.bad("expected " + std::string(ros1::node_conditions) + " in after, found '" + text + "'");
  }
}

void read_parameters_of_node(const YamlNode& params, const std::string& node, ros1::Launch& launch) {
  if (params.kind != YamlNode::Kind::map)
    throw params.written.bad("expected params to be a map of parameters, found " + described(params));
  for (const YamlEntry& entry : params.entries) {
    if (!ros1::is_graph_name(entry.key) || entry.key.starts_with('/') || entry.key.starts_with('~'))
      throw entry.written.bad("expected the name of a node's own parameter in params, found '" + entry.key + "'");
    launch.add(ros1::resolved(entry.key, node), parameter_value(entry.value), entry.written);
  }
}

void read_node(const YamlNode& item, const std::string& ns, ros1::Launch& launch) {
  const YamlMap map(item, "a node", node_keys().names());
  ros1::Node node;
  node.written = item.written;
  node.name = map.text("name");
  if (!ros1::is_base_name(node.name))
    throw map.require("name").written.bad("expected the name of a node to be of letters, digits and '_', found '" +
                                          node.name + "'");
  node.ns = ns;
  if (const YamlNode* own = map.find("namespace"))
    node.ns = ros1::resolved(name_in_graph(*own, read_text(*own, "namespace"), "namespace"), ns);
  read_program(map, node);
  for_each_text(map, "remap", [&](const YamlEntry& entry, const std::string& to) {
    node.remappings.push_back(
        {name_in_graph(entry.value, entry.key, "a name in remap"), name_in_graph(entry.value, to, "a name in remap")});
  });
  for_each_text(map, "environment", [&](const YamlEntry& entry, const std::string& value) {
    node.environment.push_back({entry.key, value});
  });
  if (const YamlNode* after = map.find("after")) read_conditions_of_node(*after, node);
  map.read("required", node.required);
  node.output = map.one_of("output", output_words, 0) == 1 ? ros1::Node::Output::screen : ros1::Node::Output::log;
  node.clock = map.text("clock", "");
  bool clears = false, enabled = true;
  map.read("clear_params", clears);
  map.read("enabled", enabled);
  if (!enabled) return;
  const std::string name = node.global_name();
  launch.add(std::move(node));
  if (clears) launch.cleared.push_back(name);
  if (const YamlNode* params = map.find("params")) read_parameters_of_node(*params, name, launch);
}

void read_launch(const YamlNode& node, const std::string& ns, ros1::Launch& launch) {
  ros1::LaunchSurroundings surroundings = surroundings_of_process();
  ros1::LaunchRequest request;
  request.ns = ns;
  request.written = node.written;
  const YamlNode* file = &node;
  if (node.kind == YamlNode::Kind::map) {
    const YamlMap map(node, "launch", launch_keys().names());
    file = &map.require("file");
    for_each_text(map, "args",
                  [&](const YamlEntry& entry, const std::string& value) { request.arguments[entry.key] = value; });
  }
  ros1::LaunchScope scope;
  scope.file = file->written.file;
  const std::string path = ros1::Substitution(surroundings).of(read_text(*file, "launch"), scope, file->written);
  request.file = file->written.resolve(path);
  std::error_code none;
  if (!std::filesystem::is_regular_file(request.file, none))
    throw file->written.bad("expected a launch file, found '" + request.file.string() + "', which is no file");
  read_launch_file(request, surroundings, launch);
}

void read_namespace(const RobotScenario& robot, bool is_only_one, NodesScenario& nodes) {
  if (!is_only_one) {
    nodes.ns = "/" + robot.name;
    nodes.tf_prefix = robot.name;
  }
  const YamlNode* const ros = nodes.document->find("ros");
  const bool has_namespace = ros != nullptr && ros->find("namespace") != nullptr;
  if (ros != nullptr) {
    const YamlMap map(*ros, "ros", robot_ros_keys().names());
    // Both may be empty.
    const auto text_of = [&map](std::string_view key, const std::string& otherwise) {
      const YamlNode* const value = map.find(key);
      if (value == nullptr) return otherwise;
      if (value->quoted && value->text.empty()) return std::string();
      return name_in_graph(*value, read_text(*value, key), std::string(key));
    };
    nodes.ns = ros1::resolved(text_of("namespace", nodes.ns), "/");
    nodes.tf_prefix = text_of("tf_prefix", nodes.tf_prefix);
    nodes.gives_map_to_odom = map.one_of("map_to_odom", map_to_odom_words, 0) == 0;
  }
  if (!has_namespace && !ros1::is_graph_name(nodes.ns))
    throw robot.written.bad("expected a namespace in the key ros of robot '" + robot.name +
                            "', since its name is none in ROS");
}

void read_launch_of(NodesScenario& nodes) {
  auto launch = std::make_shared<ros1::Launch>();
  if (const YamlNode* file = nodes.document->find("launch")) read_launch(*file, nodes.ns, *launch);
  if (const YamlNode* list = nodes.document->find("nodes"))
    for (const YamlNode& item : read_list(*list, "nodes")) read_node(item, nodes.ns, *launch);
  settle_conditions(*launch);
  nodes.launch = std::move(launch);
}

/// The values of these keys; none if there are none.
std::optional<NodesScenario> taken(const YamlMap& holder, std::span<const std::string_view> keys) {
  YamlNode document;
  document.kind = YamlNode::Kind::map;
  for (const YamlEntry& entry : holder.node().entries)
    if (std::find(keys.begin(), keys.end(), entry.key) != keys.end() && !entry.value.is_null())
      document.entries.push_back(entry);
  if (document.entries.empty()) return std::nullopt;
  NodesScenario nodes;
  nodes.written = document.written = document.entries.front().written;
  nodes.document = std::make_shared<const YamlNode>(std::move(document));
  return nodes;
}

/// What it adds to the scenario.
void read_and_add_launch(NodesScenario& nodes, std::vector<std::string>& warnings, std::uint64_t& fingerprint) {
  if (Confinement::exists()) throw nodes.written.bad("nodes of ROS are not started with --confined");
  read_launch_of(nodes);
  const ros1::Launch& launch = *nodes.launch;
  warnings.insert(warnings.end(), launch.warnings.begin(), launch.warnings.end());
  if (launch.fingerprint != 0) fingerprint = fingerprint * 31 + launch.fingerprint;
}

// Within one master there is one node of a name.
void check_names_of_robots(const Scenario& scenario) {
  std::map<std::string, Location> namespaces;
  for (const RobotScenario& robot : scenario.robots) {
    if (!robot.nodes) continue;
    const auto [other, is_new] = namespaces.emplace(robot.nodes->ns, robot.written);
    if (!is_new)
      throw robot.written.bad("there are two robots with the namespace '" + robot.nodes->ns +
                              "' of ROS, the first at " + other->second.text());
  }
}

void check_names_of_nodes(const Scenario& scenario) {
  std::map<std::string, Location> names;
  for (const NodesScenario* const nodes : scenario.all_nodes()) {
    for (const ros1::Node& node : nodes->launch->nodes) {
      if (node.global_name() == "/waitpoint")
        throw node.written.bad("a node cannot be called '/waitpoint': the world has this name");
      const auto [first, is_first] = names.emplace(node.global_name(), node.written);
      if (!is_first)
        throw node.written.bad("there are two nodes called '" + first->first + "', the first at " +
                               first->second.text());
    }
  }
}

}  // namespace

bool RobotScenario::goals_are_for_nodes() const {
  return nodes && std::none_of(modules.begin(), modules.end(), [](const auto& module) { return module.enabled; });
}

std::vector<const NodesScenario*> Scenario::all_nodes() const {
  std::vector<const NodesScenario*> all;
  if (nodes) all.push_back(&*nodes);
  for (const RobotScenario& robot : robots)
    if (robot.nodes) all.push_back(&*robot.nodes);
  return all;
}

bool Scenario::has_nodes() const { return !all_nodes().empty(); }

RosScenario read_ros(const YamlNode& node) {
  RosScenario ros;
  ros.written = node.written;
  read_object(node, "ros", ros_keys(), ros);
  return ros;
}

std::optional<NodesScenario> take_nodes(const YamlMap& robot) { return taken(robot, keys_of_robot); }

void take_nodes_beside_bag(const YamlMap& scenario, Scenario& taking) {
  taking.nodes = taken(scenario, keys_beside_bag);
  if (taking.nodes && !taking.play)
    throw taking.nodes->written.bad("expected nodes and launch in a robot, or a bag that is played to them: play");
}

void read_nodes(Scenario& scenario) {
  const auto count = std::count_if(scenario.robots.begin(), scenario.robots.end(),
                                   [](const RobotScenario& robot) { return robot.nodes.has_value(); });
  if (scenario.nodes) read_and_add_launch(*scenario.nodes, scenario.warnings, scenario.fingerprint);
  for (RobotScenario& robot : scenario.robots) {
    if (!robot.nodes) continue;
    read_namespace(robot, count == 1, *robot.nodes);
    read_and_add_launch(*robot.nodes, robot.warnings, scenario.fingerprint);
    (void)poster_topics(*robot.nodes);
    (void)shown_topics(*robot.nodes);
  }
  check_names_of_robots(scenario);
  check_names_of_nodes(scenario);
  if (scenario.play && !scenario.has_nodes())
    throw scenario.play->written.bad("expected nodes or launch, since the bag is played to nodes of ROS, found none");
}

}  // namespace waitpoint::scenario
