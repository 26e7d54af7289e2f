// SPDX-License-Identifier: BSD-3-Clause
// A run whose robots have ROS nodes: this program runs itself, with the master, the world and all nodes, as the
// processes of one simulation (tools/exec), in which everything shares one virtual time.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "tools/exec/program_conditions.hpp"

namespace waitpoint::tools {

/// True in a process of such a simulation, where the wall clock shows virtual time.
bool is_among_nodes();

/// Figures of the simulation itself, as printed: processes, threads, events, and the time it took.
enum class Report : std::uint8_t { none, at_end };

/// The cost of computing in it.
ProgramConditions conditions_of_nodes();

/// The run, by this program's arguments; returns its status. The order of the nodes' events at one instant follows
/// from the seed.
int run_among_nodes(std::span<const std::string> arguments, std::uint64_t seed, Report report = Report::at_end);

}  // namespace waitpoint::tools
