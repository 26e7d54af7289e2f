// SPDX-License-Identifier: BSD-3-Clause
// Reads launch files of ROS 1 (XML, as roslaunch does): nodes, their parameters, remappings and environment.
//
// Elements: launch, node, test, param, rosparam, remap, env, arg, group, include. Texts may have substitution
// arguments: substitution.hpp. As in roslaunch, a group, a node and an included file have a scope of their own, a later
// parameter replaces an earlier one, and `~` parameters of a scope go to each node that follows in it. Unlike there,
//
//   nothing is executed (`command` of param, `launch-prefix`), nothing is started again (`respawn`), there is one
//   machine; paths are relative to the file that names them; unknown elements and attributes, and arguments that a file
//   does not declare, are errors;
//   $(anon WORD) is numbered, so that a launch file gives the same names each time.
//
// Bounds: includes are 32 deep, 1000 altogether; 64 MiB of files; 20 000 elements; 4096 nodes.
#pragma once

#include <filesystem>

#include "modules/ros1/launch.hpp"
#include "modules/ros1/launch_scope.hpp"
#include "modules/ros1/launch_surroundings.hpp"

namespace waitpoint::ros1 {

struct LaunchRequest {
  std::filesystem::path file;
  LaunchArguments arguments;
  std::string ns = "/";  ///< in which the file's names are
  Location written;      ///< of the request, for errors of its arguments
};

/// Adds the file's contents to `launch`. BadInput: "FILE:LINE: expected ..., found ...", with the places of the
/// includes that lead to the file; `launch` is then of no use.
void read_launch_file(const LaunchRequest& request, LaunchSurroundings& surroundings, Launch& launch);

}  // namespace waitpoint::ros1
