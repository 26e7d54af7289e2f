// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/launch_nodes.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <optional>

#include "core/number_text.hpp"
#include "modules/ros1/graph_name.hpp"
#include "modules/ros1/launch_parameters.hpp"
#include "modules/ros1/words_of_text.hpp"

namespace waitpoint::ros1 {
namespace {

constexpr std::size_t nodes_max = 4096;

void refuse_what_is_not_simulated(const LaunchElement& element) {
  if (element.find("launch-prefix"))
    throw element.bad(
        "expected no 'launch-prefix': nodes are started in the simulation, `waitpoint explore` and `gdb` "
        "are for the whole of it");
  if (element.find("machine")) throw element.bad("expected no 'machine': all nodes of a simulation have one");
  if (element.truth("respawn", false))
    throw element.bad("expected no respawn: a node that ends is a result of the run, not started again");
}

// The common part of <node> and <test>. The name is read.
void read_common(const LaunchElement& element, LaunchScope& scope, LaunchReading& reading, Node& node) {
  if (!is_base_name(node.name))
    throw element.bad("expected the name of a node to be of letters, digits and '_', found '" + node.name + "'" +
                      (node.name.find('/') != node.name.npos ? "; namespaces are in 'ns'" : ""));
  refuse_what_is_not_simulated(element);
  node.written = element.written();
  node.ns = namespace_of(element, scope);
  node.package = element.require("pkg");
  node.type = element.require("type");
  const std::string arguments = element.find("args").value_or("");
  if (!split_words(arguments, node.arguments))
    throw element.bad("expected a closing quote in 'args' of " + in_brackets(element.name()) + ", found '" + arguments +
                      "'");
  constexpr std::string_view folders[] = {"ROS_HOME", "node", "ros_home"};
  node.folder = element.one_of("cwd", folders, 0) == 1 ? Node::Folder::of_program : Node::Folder::ros_home;
  node.required = element.truth("required", false);
  const std::string name = node.global_name();
  if (element.truth("clear_params", false)) reading.launch.cleared.push_back(name);
  for (const auto& [key, parameter] : scope.node_parameters)
    reading.launch.add(resolved(key, name), parameter.value, parameter.written);
  constexpr std::string_view inner[] = {"param", "rosparam", "remap", "env"};
  for (const auto* child = element.xml().FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    reading.count(*child, scope);
    require_known(scope, *child, element.name(), inner);
    const std::string_view kind = child->Name();
    if (kind == "param") read_param(*child, scope, reading, name);
    if (kind == "rosparam") read_rosparam(*child, scope, reading, name);
    if (kind == "remap") read_remap(*child, scope, reading);
    if (kind == "env") read_environment(*child, scope, reading);
  }
  node.remappings = scope.remappings;
  node.environment = scope.environment;
  if (reading.launch.nodes.size() + reading.launch.tests.size() >= nodes_max)
    throw element.bad("expected at most " + std::to_string(nodes_max) + " nodes");
}

std::string name_in_remap(const LaunchElement& element, const char* attribute) {
  std::string name = without_extra_slashes(element.require(attribute));
  if (!is_graph_name(name))
    throw element.bad("expected '" + std::string(attribute) + "' of <remap> to be a name of ROS, found '" + name + "'");
  return name;
}

}  // namespace

std::string namespace_of(const LaunchElement& element, const LaunchScope& scope) {
  const std::optional<std::string> ns = element.find("ns");
  if (!ns) return scope.ns;
  if (ns->starts_with('~') || !is_graph_name(without_extra_slashes(*ns)))
    throw element.bad("expected 'ns' of " + in_brackets(element.name()) + " to be a namespace, found '" + *ns + "'");
  return resolved(*ns, scope.ns);
}

void read_node(const tinyxml2::XMLElement& xml, LaunchScope& around, LaunchReading& reading) {
  LaunchScope scope = around;
  const LaunchElement element(xml, scope, reading.substitution,
                              {"pkg", "type", "name", "ns", "args", "output", "required", "respawn", "respawn_delay",
                               "launch-prefix", "machine", "clear_params", "cwd"});
  if (!element.applies()) return;
  Node node;
  node.name = element.require("name");
  constexpr std::string_view outputs[] = {"log", "screen"};
  node.output = element.one_of("output", outputs, 0) == 1 ? Node::Output::screen : Node::Output::log;
  read_common(element, scope, reading, node);
  around.anonymous = scope.anonymous;
  reading.launch.add(std::move(node));
}

void read_test(const tinyxml2::XMLElement& xml, LaunchScope& around, LaunchReading& reading) {
  LaunchScope scope = around;
  const LaunchElement element(xml, scope, reading.substitution,
                              {"pkg", "type", "name", "ns", "args", "test-name", "time-limit", "retry", "required",
                               "launch-prefix", "machine", "clear_params", "cwd"});
  if (!element.applies()) return;
  LaunchTest test;
  test.name = element.require("test-name");
  test.node.name = element.find("name").value_or(test.name);
  if (const auto limit = element.find("time-limit"))
    if (!parse_number(*limit, test.time_limit_s) || !(test.time_limit_s > 0))
      throw element.bad("expected 'time-limit' of <test> to be a positive number of seconds, found '" + *limit + "'");
  if (const auto retry = element.find("retry"))
    if (!parse_number(*retry, test.retries) || test.retries < 0)
      throw element.bad("expected 'retry' of <test> to be a number of repetitions, found '" + *retry + "'");
  read_common(element, scope, reading, test.node);
  around.anonymous = scope.anonymous;
  reading.launch.tests.push_back(std::move(test));
}

void read_remap(const tinyxml2::XMLElement& xml, LaunchScope& scope, LaunchReading& reading) {
  const LaunchElement element(xml, scope, reading.substitution, {"from", "to"});
  if (!element.applies()) return;
  Remapping remapping{name_in_remap(element, "from"), name_in_remap(element, "to")};
  std::erase_if(scope.remappings, [&](const Remapping& other) { return other.from == remapping.from; });
  scope.remappings.push_back(std::move(remapping));
}

void read_environment(const tinyxml2::XMLElement& xml, LaunchScope& scope, LaunchReading& reading) {
  const LaunchElement element(xml, scope, reading.substitution, {"name", "value"});
  if (!element.applies()) return;
  const std::optional<std::string> value = element.find("value");
  if (!value) throw element.bad("expected the attribute 'value' of <env>, found none");
  EnvironmentVariable variable{element.require("name"), *value};
  if (variable.name.find('=') != variable.name.npos)
    throw element.bad("expected the name of a variable in <env>, found '" + variable.name + "'");
  std::erase_if(scope.environment, [&](const EnvironmentVariable& other) { return other.name == variable.name; });
  scope.environment.push_back(std::move(variable));
}

}  // namespace waitpoint::ros1
