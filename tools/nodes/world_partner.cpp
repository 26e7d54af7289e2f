// SPDX-License-Identifier: BSD-3-Clause
#include "tools/nodes/world_partner.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "fibers/sync/system_calls.hpp"
#include "modules/nodes/world_node.hpp"
#include "modules/nodes/world_topics.hpp"
#include "modules/ros1/packages.hpp"
#include "modules/run/known_map.hpp"
#include "tools/command/installed_part.hpp"

namespace waitpoint::tools {
namespace {

std::filesystem::path library(const scenario::Location& written) {
  try {
    return find_part(nodes::Library::file);
  } catch (const BadInput&) {
    throw written.bad("ROS nodes are not in this program: `./dev ros` installs what they need, and builds it again");
  }
}

const nodes::Library& load(const std::filesystem::path& path, const scenario::Location& written) {
  void* const object = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (object == nullptr) throw written.bad(std::string("the library for ROS nodes cannot be loaded: ") + dlerror());
  const auto* const loaded = static_cast<const nodes::Library*>(dlsym(object, nodes::Library::symbol));
  if (loaded == nullptr) throw written.bad("the library for ROS nodes is of another version");
  return *loaded;
}

std::optional<std::string> variable(const std::string& name) {
  const char* const value = std::getenv(name.c_str());
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

std::string missing(const ros1::Node& node, ros1::Packages& packages) {
  std::string text = packages.folder(node.package)
                         ? "the package '" + node.package + "' has no executable '" + node.type + "'"
                         : "there is no package '" + node.package + "'";
  text += ", looked for in";
  for (const std::filesystem::path& root : packages.roots()) text += " " + root.string();
  return text;
}

std::vector<std::string> words_of(const ros1::Node& node, ros1::Packages& packages) {
  std::vector<std::string> words = node.command;
  if (words.empty()) {
    const auto executable = packages.executable(node.package, node.type);
    if (!executable) throw node.written.bad(missing(node, packages));
    words.push_back(executable->string());
  }
  words.insert(words.end(), node.arguments.begin(), node.arguments.end());
  return words;
}

std::vector<nodes::NodeCommand> commands_of(const scenario::Scenario& scenario) {
  ros1::Packages packages = ros1::Packages::of(variable);
  std::vector<nodes::NodeCommand> commands;
  for (const std::size_t robot : nodes::robots_with_nodes(scenario))
    for (const ros1::Node& node : scenario.robots[robot].nodes->launch->nodes)
      commands.push_back({node, words_of(node, packages)});
  return commands;
}

const scenario::RobotScenario& first_with_nodes(const scenario::Scenario& scenario) {
  return scenario.robots[nodes::robots_with_nodes(scenario).front()];
}

}  // namespace

void check_nodes(const scenario::Scenario& scenario) {
  (void)library(first_with_nodes(scenario).nodes->written);
  if (scenario.ros.master == scenario::RosScenario::Master::outside)
    throw scenario.ros.written.bad("expected the master inside: one outside is not in the run's virtual time");
  for (const nodes::NodeCommand& command : commands_of(scenario))
    if (!command.node.clock.empty())
      throw command.node.written.bad("expected no clock: computing of nodes takes no virtual time yet");
}

std::unique_ptr<outside::Partner> make_world_partner(const scenario::Scenario& scenario) {
  const scenario::RobotScenario& first = first_with_nodes(scenario);
  std::vector<nodes::NodeCommand> commands = commands_of(scenario);
  std::optional<scenario::MapFile> map = scenario.map;
  if (map) map->read();
  const OccupancyGrid known = run::known_map(scenario, map ? map->contents.get() : nullptr, first);
  std::unique_ptr<nodes::NodeSide> side;
  const sync::UnnotedThreads of_ros;
  try {
    side = load(library(first.nodes->written), first.nodes->written).make(nodes::node_side_setup(scenario, known));
  } catch (const std::runtime_error& error) {
    throw first.nodes->written.bad(error.what());
  }
  return std::make_unique<nodes::WorldNode>(scenario, nodes::robots_with_nodes(scenario), std::move(side),
                                            std::move(commands));
}

}  // namespace waitpoint::tools
