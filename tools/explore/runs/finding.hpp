// SPDX-License-Identifier: BSD-3-Clause
// The result of one schedule of a scenario or a program. Computed in a process of its own and sent through a pipe, from
// a program to itself, as bytes.
#pragma once

#include <string>
#include <string_view>

#include "fibers/explore/target/finding.hpp"
#include "fibers/explore/target/plan.hpp"
#include "fibers/explore/target/wanted_evidence.hpp"
#include "fibers/posix/traps/access_obstacle.hpp"
#include "tools/exec/switch_at.hpp"

namespace waitpoint::tools {

using exploration::Plan;
using exploration::ToldRace;
using exploration::WantedEvidence;

struct ProcessFinding : exploration::Finding {
  SwitchAt switch_at = SwitchAt::automatic;  ///< of a program that is not instrumented: calls or accesses
  posix::AccessObstacle obstacle = posix::AccessObstacle::none;  ///< why it has calls in place of accesses
};

std::string to_bytes(const ProcessFinding& finding);
/// Parses the complete output of to_bytes().
ProcessFinding finding_of(std::string_view bytes);
/// "wp1:0123456789abcdef".
std::string digest_text(std::uint64_t digest);

}  // namespace waitpoint::tools
