// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/launch_file.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <map>
#include <optional>

#include "core/nearest_name.hpp"
#include "core/xml/xml_reader.hpp"
#include "modules/ros1/launch_element.hpp"
#include "modules/ros1/launch_nodes.hpp"
#include "modules/ros1/launch_parameters.hpp"
#include "modules/ros1/launch_reading.hpp"

namespace waitpoint::ros1 {
namespace {

constexpr std::size_t depth_max = 32, files_max = 1000;

/// Where each argument is given that is passed to a file.
using PassedFrom = std::map<std::string, Location, std::less<>>;

void read_elements(const tinyxml2::XMLElement& holder, LaunchScope& scope, LaunchReading& reading);

void read_argument(const tinyxml2::XMLElement& xml, LaunchScope& scope, LaunchReading& reading) {
  const LaunchElement element(xml, scope, reading.substitution, {"name", "default", "value", "doc"});
  if (!element.applies()) return;
  const std::string name = element.require("name");
  if (!scope.declared.insert(name).second) throw element.bad("the argument '" + name + "' is declared twice");
  const std::optional<std::string> value = element.find("value"), otherwise = element.find("default");
  if (value && otherwise) throw element.bad("expected 'value' or 'default' of <arg>, found both");
  if (value) {
    if (scope.arguments.contains(name) && !scope.may_give_again)
      throw element.bad("the argument '" + name + "' has a 'value' here, it cannot be given from outside");
    scope.arguments[name] = *value;
  } else if (otherwise) {
    scope.arguments.emplace(name, *otherwise);
  }
}

void read_group(const tinyxml2::XMLElement& xml, LaunchScope& around, LaunchReading& reading) {
  LaunchScope scope = around;
  const LaunchElement element(xml, scope, reading.substitution, {"ns", "clear_params"});
  if (!element.applies()) return;
  scope.ns = namespace_of(element, around);
  if (element.truth("clear_params", false)) {
    if (!element.find("ns")) throw element.bad("expected 'ns' of a <group> that has 'clear_params'");
    reading.launch.cleared.push_back(scope.ns);
  }
  read_elements(xml, scope, reading);
}

// All that the file declares outside of groups may be passed to it.
void check_passed(const LaunchScope& scope, const PassedFrom& passed) {
  for (const auto& [name, written] : passed) {
    if (scope.declared.contains(name)) continue;
    const std::vector<std::string_view> names(scope.declared.begin(), scope.declared.end());
    throw written.bad("the file '" + scope.file.text() + "' has no argument '" + name + "'" +
                      did_you_mean(name, names));
  }
}

void read_file(LaunchScope& scope, LaunchReading& reading) {
  const std::string& file = scope.file;
  if (reading.open.size() == depth_max)
    throw BadInput(file, "expected includes of at most " + std::to_string(depth_max) + " levels");
  if (++reading.files > files_max)
    throw BadInput(file, "expected at most " + std::to_string(files_max) + " launch files, each counted when included");
  const XmlReader document(reading.contents_of(file, "a launch file"), file, "launch");
  std::error_code none;
  std::filesystem::path canonical = std::filesystem::weakly_canonical(file, none);
  if (std::find(reading.open.begin(), reading.open.end(), canonical) != reading.open.end())
    throw BadInput(file, "expected a file that does not include itself");
  reading.open.push_back(std::move(canonical));
  const LaunchElement launch(document.root(), scope, reading.substitution, {"deprecated"});
  if (const auto message = launch.find("deprecated"))
    reading.launch.warnings.push_back(launch.written().text() + ": the launch file is deprecated: " + *message);
  read_elements(document.root(), scope, reading);
  reading.open.pop_back();
}

void read_include(const tinyxml2::XMLElement& xml, LaunchScope& around, LaunchReading& reading) {
  LaunchScope given = around;
  const LaunchElement element(xml, given, reading.substitution, {"file", "ns", "clear_params", "pass_all_args"});
  if (!element.applies()) return;
  LaunchScope inner = around;
  inner.file = LaunchReading::path_in(around, element.require("file"));
  inner.ns = namespace_of(element, around);
  inner.may_give_again = element.truth("pass_all_args", false);
  if (!inner.may_give_again) inner.arguments.clear();
  inner.declared.clear();
  inner.anonymous.clear();
  if (element.truth("clear_params", false)) {
    if (!element.find("ns")) throw element.bad("expected 'ns' of an <include> that has 'clear_params'");
    reading.launch.cleared.push_back(inner.ns);
  }
  PassedFrom passed;
  constexpr std::string_view known[] = {"arg", "env"};
  for (const auto* child = xml.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    reading.count(*child, given);
    require_known(given, *child, "include", known);
    if (std::string_view(child->Name()) == "env") {
      read_environment(*child, given, reading);
      continue;
    }
    const LaunchElement argument(*child, given, reading.substitution, {"name", "default", "value", "doc"});
    if (!argument.applies()) continue;
    const std::string name = argument.require("name");
    const std::optional<std::string> value = argument.find("value"), otherwise = argument.find("default");
    if (value.has_value() == otherwise.has_value())
      throw argument.bad("expected a 'value' of the argument '" + name + "' that is passed, found " +
                         (value ? "a 'default', too" : "none"));
    if (!passed.emplace(name, argument.written()).second)
      throw argument.bad("the argument '" + name + "' is passed twice");
    inner.arguments[name] = value ? *value : *otherwise;
  }
  inner.environment = given.environment;
  try {
    read_file(inner, reading);
  } catch (const BadInput& bad) {
    throw bad.with_note(" (included at " + element.written().text() + ")");
  }
  if (!inner.may_give_again) check_passed(inner, passed);
}

void read_elements(const tinyxml2::XMLElement& holder, LaunchScope& scope, LaunchReading& reading) {
  constexpr std::string_view known[] = {"node", "test", "param", "rosparam", "remap", "env", "group", "arg", "include"};
  for (const auto* child = holder.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    reading.count(*child, scope);
    require_known(scope, *child, holder.Name(), known);
    const std::string_view kind = child->Name();
    if (kind == "node") read_node(*child, scope, reading);
    if (kind == "test") read_test(*child, scope, reading);
    if (kind == "param") read_param(*child, scope, reading);
    if (kind == "rosparam") read_rosparam(*child, scope, reading);
    if (kind == "remap") read_remap(*child, scope, reading);
    if (kind == "env") read_environment(*child, scope, reading);
    if (kind == "group") read_group(*child, scope, reading);
    if (kind == "arg") read_argument(*child, scope, reading);
    if (kind == "include") read_include(*child, scope, reading);
  }
}

}  // namespace

void read_launch_file(const LaunchRequest& request, LaunchSurroundings& surroundings, Launch& launch) {
  LaunchReading reading(surroundings, launch);
  LaunchScope scope;
  scope.file = request.file.string();
  scope.ns = request.ns;
  scope.arguments = request.arguments;
  PassedFrom passed;
  for (const auto& [name, value] : request.arguments) passed.emplace(name, request.written);
  read_file(scope, reading);
  check_passed(scope, passed);
}

}  // namespace waitpoint::ros1
