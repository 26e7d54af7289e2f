// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/launch_parameters.hpp"

#include <algorithm>
#include <optional>

#include "modules/ros1/graph_name.hpp"
#include "modules/ros1/launch_element.hpp"
#include "modules/ros1/parameter_text.hpp"

namespace waitpoint::ros1 {
namespace {

bool is_blank(std::string_view text) { return text.find_first_not_of(" \t\r\n") == text.npos; }

std::string text_of_param(const LaunchElement& element, const LaunchScope& scope, LaunchReading& reading) {
  for (const char* refused : {"command", "binfile"})
    if (element.find(refused))
      throw element.bad("expected no '" + std::string(refused) +
                        "' of <param>: nothing is executed while a launch file is read; save the command's output, and "
                        "give it as 'textfile'");
  const std::optional<std::string> value = element.find("value"), file = element.find("textfile");
  if (value.has_value() == file.has_value())
    throw element.bad("expected 'value' or 'textfile' of <param>, found " + std::string(value ? "both" : "none"));
  return value ? *value : reading.contents_of(LaunchReading::path_in(scope, *file), "a text for a parameter");
}

nlohmann::json value_of_param(const LaunchElement& element, const LaunchScope& scope, LaunchReading& reading) {
  const std::string_view type = parameter_types[element.one_of("type", parameter_types, 0)];
  const std::string text = text_of_param(element, scope, reading);
  if (type == "yaml") {
    const int line = element.written().line;
    return reading.surroundings.yaml(std::string(static_cast<std::size_t>(line - 1), '\n') + text,
                                     element.written().file);
  }
  nlohmann::json value;
  if (!read_parameter(text, type, value))
    throw element.bad("expected a value of type " + std::string(type) + " in <param>, found '" + text + "'");
  return value;
}

void add(const std::string& name, nlohmann::json value, const LaunchElement& element, LaunchScope& scope,
         LaunchReading& reading, const std::string& node) {
  const Location written = element.written();
  if (!node.empty())
    reading.launch.add(resolved(name, node, node), value, written);
  else if (name.starts_with('~'))
    scope.node_parameters[resolved(name, "/", "/").substr(1)] = {std::move(value), written};
  else
    reading.launch.add(resolved(name, scope.ns), value, written);
}

}  // namespace

void read_param(const tinyxml2::XMLElement& xml, LaunchScope& scope, LaunchReading& reading, const std::string& node) {
  const LaunchElement element(xml, scope, reading.substitution,
                              {"name", "value", "type", "textfile", "binfile", "command"});
  if (!element.applies()) return;
  std::string name = element.require("name");
  if (!is_graph_name(name) || name == "/")
    throw element.bad("expected the name of a parameter in <param>, found '" + name + "'");
  // Within a node all are its own.
  if (!node.empty()) name.erase(0, name.find_first_not_of('/'));
  add(name, value_of_param(element, scope, reading), element, scope, reading, node);
}

void read_rosparam(const tinyxml2::XMLElement& xml, LaunchScope& scope, LaunchReading& reading,
                   const std::string& node) {
  const LaunchElement element(xml, scope, reading.substitution, {"command", "ns", "file", "param", "subst_value"});
  if (!element.applies()) return;
  constexpr std::string_view commands[] = {"load"};
  element.one_of("command", commands, 0);
  std::optional<std::string> file = element.find("file");
  if (file) file = LaunchReading::path_in(scope, *file);
  std::string text = element.text_at_its_lines();
  if (file && !is_blank(text)) throw element.bad("expected a file or a text of <rosparam>, found both");
  if (file) text = reading.contents_of(*file, "parameters in YAML");
  if (element.truth("subst_value", false)) text = reading.substitution.of(text, scope, element.written());
  nlohmann::json value = reading.surroundings.yaml(text, file ? *file : element.written().file.text());
  const std::string param = element.find("param").value_or(""), ns = element.find("ns").value_or("");
  const std::string name = param.empty() ? ns : ns.empty() ? param : resolved(param, ns);
  if (!name.empty() && !is_graph_name(name)) throw element.bad("expected a name in <rosparam>, found '" + name + "'");
  if (value.is_null()) value = nlohmann::json::object();
  if (name.empty() && !value.is_object()) throw element.bad("expected 'param' of <rosparam>, or a map of parameters");
  add(name, std::move(value), element, scope, reading, node);
}

}  // namespace waitpoint::ros1
