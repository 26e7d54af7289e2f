// SPDX-License-Identifier: BSD-3-Clause
// The schedules of a finding, for a page: the events of the failing run and of the passing one beside it, both events
// of the pair in each with their call stacks, and of a scenario the floor.
#pragma once

#include "fibers/explore/report/finding_file.hpp"
#include "tools/explore/report/reversed_events.hpp"
#include "tools/explore/runs/target.hpp"

namespace waitpoint::tools {

/// Repeats the runs a few times. A schedule whose process was killed has no events.
void add_schedules(Target& target, const Plan& failing, const Finding& failure, const ReversedEvents& reversed,
                   exploration::FindingFile& finding);

}  // namespace waitpoint::tools
