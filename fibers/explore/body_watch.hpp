// SPDX-License-Identifier: BSD-3-Clause
// Runs of a body under observation: its profile, timeline, events and trail.
#pragma once

#include "fibers/explore/body.hpp"
#include "fibers/explore/report/timeline.hpp"
#include "fibers/explore/schedules/event_log.hpp"
#include "fibers/explore/schedules/trail.hpp"
#include "fibers/explore/strategies/profile.hpp"

namespace waitpoint::exploration {

/// Runs `body` in the default order and records its profile; returns the result.
Outcome take_profile(Body& body, Profile& profile);

/// Runs `body` by these decisions, then in the default order, and records its timeline.
Timeline take_timeline(Body& body, std::span<const Decision> decisions);

/// Runs `body` by these decisions, then in the default order: its events after decision `from`.
std::vector<DoneEvent> take_events(Body& body, std::span<const Decision> decisions, std::size_t from);

/// Runs `body` once more by `schedule`: its trail, with a mark after each 2^log_spacing events.
Trail take_trail(Body& body, const Schedule& schedule, std::uint32_t log_spacing);

}  // namespace waitpoint::exploration
