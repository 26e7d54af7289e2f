// SPDX-License-Identifier: BSD-3-Clause
// What the runs of a body show beside what they come to.
#pragma once

#include "fibers/explore/body.hpp"
#include "fibers/explore/report/timeline.hpp"
#include "fibers/explore/schedules/event_log.hpp"
#include "fibers/explore/schedules/trail.hpp"
#include "fibers/explore/strategies/profile.hpp"

namespace waitpoint::exploration {

/// Runs `body` in the default order and looks at what it does; what that came to.
Outcome take_profile(Body& body, Profile& profile);

/// Runs `body` once more by `schedule`, and looks.
Timeline take_timeline(Body& body, const Schedule& schedule);

/// Runs `body` by these decisions, and then in the default order: its events behind decision `from`.
std::vector<DoneEvent> take_events(Body& body, std::span<const Decision> decisions, std::size_t from);

/// Runs `body` once more by `schedule`: its trail, with a mark behind each 2^log_spacing events.
Trail take_trail(Body& body, const Schedule& schedule, std::uint32_t log_spacing);

}  // namespace waitpoint::exploration
