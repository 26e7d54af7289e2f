// SPDX-License-Identifier: BSD-3-Clause
// Names in ROS's graph of nodes, topics, services and parameters.
//
// A name is of words [A-Za-z][A-Za-z0-9_]*, joined by '/'. With a '/' in front it is global; with a '~' it is private
// to a node; else it is relative to a namespace. A namespace is a global name without a '/' at its end; "/" is the
// root.
#pragma once

#include <string>
#include <string_view>

namespace waitpoint::ros1 {

/// True for a name of one word, as nodes have within their namespaces.
bool is_base_name(std::string_view name);
/// True for a relative, global or private name; words after the first may begin with a digit or '_'.
bool is_graph_name(std::string_view name);

/// `name` without double slashes, and without one at its end unless it is "/".
std::string without_extra_slashes(std::string_view name);

/// The global name of a relative or global `name` in a namespace.
std::string resolved(std::string_view name, std::string_view ns);
/// The same; a private one is that of the node with the global name `node`.
std::string resolved(std::string_view name, std::string_view ns, std::string_view node);

}  // namespace waitpoint::ros1
