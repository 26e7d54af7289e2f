// SPDX-License-Identifier: BSD-3-Clause
// The nodes of ROS 1 that are a robot's software, and their parameters, as values: what a launch file and the keys of
// a scenario say, with all names global, and all texts substituted.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/hosting/program_host.hpp"
#include "core/location.hpp"
#include "modules/ros1/node_condition.hpp"

namespace waitpoint::ros1 {

/// A name of a node's code, and the one used in its place; as written, relative to the node's namespace.
struct Remapping {
  std::string from, to;
};

struct Node {
  enum class Output : unsigned char { log, screen };
  enum class Folder : unsigned char { ros_home, of_program };

  std::string name;                    ///< a base name
  std::string ns = "/";                ///< its namespace
  std::vector<std::string> command;    ///< a program (a path, or a name to find by PATH) and words; empty: a package's
  std::string package, type;           ///< without a command: the executable `type` of the package
  std::vector<std::string> arguments;  ///< after the command or the executable
  std::vector<Remapping> remappings;   ///< no two from one name
  std::vector<StartCondition> after;   ///< its start waits for all; names are those of nodes of the launch
  std::vector<EnvironmentVariable> environment;  ///< besides the one of the run; no two of one name
  std::string clock;      ///< time that its computing takes, as of `waitpoint exec --clock`; may be empty
  bool required = false;  ///< its end is the end of the run
  Output output = Output::log;
  Folder folder = Folder::ros_home;  ///< in which it starts
  Location written;

  std::string global_name() const;
};

/// A node that tests others and ends (`test` of a launch file): it is not part of a run.
struct LaunchTest {
  static constexpr double time_limit_default_s = 60;

  Node node;
  std::string name;
  double time_limit_s = time_limit_default_s;
  int retries = 0;
};

/// A value for the parameter server: a bool, 32-bit integer, double, string or list. Elements of a map are parameters
/// of their own, except within a list.
struct Parameter {
  nlohmann::json value;
  Location written;
};

struct Launch {
  std::vector<Node> nodes;  ///< in the order in which they start; no two of one global name
  std::vector<LaunchTest> tests;
  /// By global name, with the private ones of nodes: "/rackham/driver/speed_m_s". None is within another.
  std::map<std::string, Parameter> parameters;
  std::vector<std::string> cleared;   ///< namespaces whose parameters are deleted before `parameters` are set
  std::vector<std::string> warnings;  ///< from launch files
  std::uint64_t fingerprint = 0;      ///< of the texts of all files that were read; 0 without any

  /// BadInput if there is a node of its global name, with both places.
  void add(Node node);
  /// Adds a value, or each element of a map. It replaces an earlier one of the name; an empty map adds nothing.
  /// BadInput at `written` for a null, a number that XML-RPC does not have, an element of no valid name, and for a
  /// parameter that is within another one, or has others within.
  void add(const std::string& name, const nlohmann::json& value, const Location& written);
  /// Adds a text to the fingerprint.
  void add_text(const std::string& text);
};

/// BadInput for a condition on a node that the launch does not have, or has in several namespaces but not that of the
/// node that waits, and for conditions in a cycle. Names of nodes in conditions become global.
void settle_conditions(Launch& launch);

}  // namespace waitpoint::ros1
