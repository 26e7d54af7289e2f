// SPDX-License-Identifier: BSD-3-Clause
// The elements `param` and `rosparam` of a launch file.
#pragma once

#include <string>

#include "modules/ros1/launch_reading.hpp"

namespace waitpoint::ros1 {

/// Reads <param>. Outside of nodes (`node` empty) the parameter is one of the scope's namespace or, with '~' before its
/// name, of all nodes that follow in the scope; within the node of the global name `node` it is the node's.
void read_param(const tinyxml2::XMLElement& element, LaunchScope& scope, LaunchReading& reading,
                const std::string& node = "");

/// Reads <rosparam>: parameters in YAML, of the element's text or a file; of namespaces as above.
void read_rosparam(const tinyxml2::XMLElement& element, LaunchScope& scope, LaunchReading& reading,
                   const std::string& node = "");

}  // namespace waitpoint::ros1
