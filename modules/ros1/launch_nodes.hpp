// SPDX-License-Identifier: BSD-3-Clause
// The elements of a launch file that make nodes, and those that apply to nodes: `node`, `test`, `remap`, `env`.
#pragma once

#include "modules/ros1/launch_element.hpp"
#include "modules/ros1/launch_reading.hpp"

namespace waitpoint::ros1 {

/// Reads <node> or <test>, with the elements in it, and adds it to the launch.
void read_node(const tinyxml2::XMLElement& element, LaunchScope& scope, LaunchReading& reading);
void read_test(const tinyxml2::XMLElement& element, LaunchScope& scope, LaunchReading& reading);

/// Read <remap> and <env> into the scope, in place of those of the same names.
void read_remap(const tinyxml2::XMLElement& element, LaunchScope& scope, LaunchReading& reading);
void read_environment(const tinyxml2::XMLElement& element, LaunchScope& scope, LaunchReading& reading);

/// The namespace of `ns` in an element: the scope's if there is none. BadInput for a name that is no namespace.
std::string namespace_of(const LaunchElement& element, const LaunchScope& scope);

}  // namespace waitpoint::ros1
