// SPDX-License-Identifier: BSD-3-Clause
#include "tools/nodes/node_commands.hpp"

#include <cstdlib>
#include <filesystem>

#include "core/file_list.hpp"
#include "core/program_path.hpp"
#include "fibers/clocks/clock_text.hpp"
#include "fibers/posix/program/record.hpp"
#include "modules/nodes/robots_air.hpp"
#include "modules/nodes/world_topics.hpp"
#include "modules/ros1/packages.hpp"
#include "tools/exec/program_conditions.hpp"

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
  if (const std::filesystem::path program = find_program(words.front()); !program.empty())
    FileList::add(program, FileRole::executed);
  words.insert(words.end(), node.arguments.begin(), node.arguments.end());
  return words;
}

std::string clock_word(const ros1::Node& node) {
  const std::optional<kernel::ClockOptions> clock = parse_clock(node.clock);
  if (!clock || !repeats(*clock))
    throw node.written.bad("expected the clock of node '" + node.name +
                           "' to be fixed:US, interval:US..US or counted[:NS], found '" + node.clock + "'");
  char text[kernel::clock_text_size];
  kernel::write_clock(*clock, text);
  return text;
}

// Settings that the layer below the program reads: see posix/program/record.hpp.
void add_environment(ros1::Node& node, std::optional<std::size_t> robot) {
  node.environment.push_back({posix::name_variable, node.global_name()});
  if (robot) node.environment.push_back({posix::robot_variable, std::to_string(nodes::number_on_air(*robot))});
  if (!node.clock.empty()) node.environment.push_back({posix::clock_variable, clock_word(node)});
}

// The place among the robots with nodes; none of nodes without a robot.
std::optional<std::size_t> robot_of(const scenario::NodesScenario& nodes, const scenario::Scenario& scenario) {
  const std::vector<std::size_t> robots = nodes::robots_with_nodes(scenario);
  for (std::size_t i = 0; i < robots.size(); ++i)
    if (&*scenario.robots[robots[i]].nodes == &nodes) return i;
  return std::nullopt;
}

}  // namespace

std::vector<nodes::NodeCommand> node_commands(const scenario::Scenario& scenario) {
  ros1::Packages packages = ros1::Packages::of(variable);
  std::vector<nodes::NodeCommand> commands;
  for (const scenario::NodesScenario* const of : scenario.all_nodes())
    for (const ros1::Node& node : of->launch->nodes) {
      commands.push_back({node, words_of(node, packages)});
      add_environment(commands.back().node, robot_of(*of, scenario));
    }
  if (!scenario.expect.tests_passed) return commands;
  for (const scenario::NodesScenario* const of : scenario.all_nodes())
    for (const ros1::LaunchTest& test : of->launch->tests) {
      commands.push_back({test.node, words_of(test.node, packages), Duration::from_seconds(test.time_limit_s)});
      add_environment(commands.back().node, robot_of(*of, scenario));
    }
  return commands;
}

}  // namespace waitpoint::tools
