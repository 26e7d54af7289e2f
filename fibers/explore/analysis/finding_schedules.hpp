// SPDX-License-Identifier: BSD-3-Clause
// The schedules of a finding, for a page: the events of the failing run and of the passing one beside it, both events
// of the pair in each with their call stacks, and of a scenario the floor.
#pragma once

#include "fibers/explore/analysis/reversed_events.hpp"
#include "fibers/explore/report/finding_file.hpp"

namespace waitpoint::exploration {

/// Repeats the runs a few times. A schedule whose process was killed has no events.
void add_schedules(Target& target, const Plan& failing, const Finding& failure, const ReversedEvents& reversed,
                   FindingFile& finding);

}  // namespace waitpoint::exploration
