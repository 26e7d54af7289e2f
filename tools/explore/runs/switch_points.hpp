// SPDX-License-Identifier: BSD-3-Clause
// Which schedules of a search have accesses to memory as switch points, of a program that is not instrumented.
#pragma once

#include "fibers/explore/target/plan.hpp"
#include "tools/explore/runs/explore_options.hpp"

namespace waitpoint::tools {

/// Never automatic. By default the first twenty schedules switch at calls, which is faster, then ten at accesses and
/// ten at calls in turn; of a program whose threads wait `at_accesses`, ten at accesses, ten at calls, then thirty at
/// accesses and ten at calls in turn. Exhaustive strategies, the default order and schedules that begin in snapshots do
/// at calls.
SwitchAt switch_points_of(const exploration::Plan& plan, const ExploreOptions& options, bool at_accesses);

/// The options by which a run with these switch points is repeated.
ExploreOptions with_switches_at(SwitchAt at, const ExploreOptions& options);

}  // namespace waitpoint::tools
