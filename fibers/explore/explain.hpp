// SPDX-License-Identifier: BSD-3-Clause
// Explains a failed schedule: the last choice from which it could still have passed, the two events that this choice
// reorders, with both call stacks, and the timeline of each task.
#pragma once

#include <string>

#include "fibers/explore/minimize.hpp"

namespace waitpoint::exploration {

/// The same failure with the tasks' source locations, which take a second to look up.
Failure with_places(Body& body, const Failure& failure);

/// The explanation, in some lines: the number of switches, and those that are not between tasks; the last choice from
/// which it could still have passed, if one was found within `effort`; and the last events.
std::string explain(Body& body, const Failure& failure, Effort effort);

}  // namespace waitpoint::exploration
