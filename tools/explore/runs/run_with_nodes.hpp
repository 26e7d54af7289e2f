// SPDX-License-Identifier: BSD-3-Clause
// A scenario whose robots have nodes of ROS is explored as a program: `waitpoint run` of it, with all processes that it
// starts, one of which is the world.
#pragma once

#include "modules/scenario/scenario.hpp"
#include "tools/explore/runs/explore_options.hpp"
#include "tools/explore/runs/finding.hpp"

namespace waitpoint::tools {

/// The options with that program. BadInput for options that it excludes, and for nodes that cannot be started.
ExploreOptions with_run_as_program(const ExploreOptions& options, const scenario::Scenario& scenario);

/// Of such a run that has failed by its status, puts what was not as expected first.
void tell_unmet(Finding& finding);

}  // namespace waitpoint::tools
