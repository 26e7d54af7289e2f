// SPDX-License-Identifier: BSD-3-Clause
// The conditions for a node's start: those of core/hosting/start_condition.hpp, whose names are those of
// nodes, and
//
//   topic:NAME    a publisher of the topic is registered with the master
//   service:NAME  a server of the service is
#pragma once

#include <string>
#include <string_view>

#include "core/hosting/start_condition.hpp"

namespace waitpoint::ros1 {

/// The syntax of parse(), for messages.
inline constexpr std::string_view node_conditions =
    "NODE, NODE.started, tcp:PORT, topic:NAME, service:NAME or a path with a '/'";

/// Parses a condition of a node in the namespace `ns`; the names of topics and services become global. False for an
/// invalid name or port, or an empty text.
bool parse(const std::string& text, std::string_view ns, StartCondition& condition);

}  // namespace waitpoint::ros1
