// SPDX-License-Identifier: BSD-3-Clause
// Waits of the nodes' threads: for calls of services, and locks that others hold.
#pragma once

#include <string>
#include <vector>

#include "core/time.hpp"

namespace waitpoint::nodes {

/// From now on waits are noted; without a layer that simulates nodes there are none.
void watch_waits();

/// Nodes note their calls of services if this library is loaded into them.
inline constexpr const char* calls_library = "libwaitpoint-node-calls.so";

/// "mapper#1002: thread 3 waits for the service /where, for 2.1 s", those that have lasted for so long.
std::vector<std::string> waits_longer_than(Duration least);
/// The same, of services alone.
std::vector<std::string> calls_longer_than(Duration least);

}  // namespace waitpoint::nodes
