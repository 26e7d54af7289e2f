// SPDX-License-Identifier: BSD-3-Clause
// The records of a run as evidence.
#pragma once

#include <string>
#include <vector>

#include "fibers/explore/report/narrator.hpp"
#include "fibers/explore/report/timeline.hpp"
#include "fibers/explore/target/finding.hpp"
#include "fibers/explore/target/wanted_evidence.hpp"

namespace waitpoint::exploration {

/// The wanted decision, or the switches, in words.
void tell(const Narration& narration, const WantedEvidence& wanted, Evidence& evidence);
/// The tasks' events.
void tell(const Timeline& timeline, const WantedEvents& wanted, Evidence& evidence);
/// The event before which the run was to end, at `time`, with its task's call stack.
void tell(Time time, const std::string& event, const std::vector<std::string>& calls, Evidence& evidence);

}  // namespace waitpoint::exploration
