// SPDX-License-Identifier: BSD-3-Clause
// The settings for the elements of a launch file at one place: a group, a node and an included file have a copy of the
// scope around them, so that their settings end with them.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "modules/ros1/launch.hpp"

namespace waitpoint::ros1 {

using LaunchArguments = std::map<std::string, std::string, std::less<>>;

struct LaunchScope {
  FileName file;                                     ///< the launch file
  std::string ns = "/";                              ///< the namespace
  LaunchArguments arguments;                         ///< those with values
  std::set<std::string, std::less<>> declared;       ///< arguments that an element `arg` has declared
  bool may_give_again = false;                       ///< arguments passed from outside replace values of the file's
  std::map<std::string, std::string> anonymous;      ///< names by their words in $(anon WORD)
  std::vector<Remapping> remappings;                 ///< no two from one name
  std::vector<EnvironmentVariable> environment;      ///< no two of one name
  std::map<std::string, Parameter> node_parameters;  ///< of each node that follows, by names within its own
};

}  // namespace waitpoint::ros1
