// SPDX-License-Identifier: BSD-3-Clause
#include "tools/nodes/node_commands.hpp"

#include <cstdlib>
#include <filesystem>

#include "modules/ros1/packages.hpp"

namespace waitpoint::tools {
namespace {

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

}  // namespace

std::vector<nodes::NodeCommand> node_commands(const scenario::Scenario& scenario) {
  ros1::Packages packages = ros1::Packages::of(variable);
  std::vector<nodes::NodeCommand> commands;
  for (const scenario::NodesScenario* const of : scenario.all_nodes())
    for (const ros1::Node& node : of->launch->nodes) commands.push_back({node, words_of(node, packages)});
  return commands;
}

}  // namespace waitpoint::tools
