// SPDX-License-Identifier: BSD-3-Clause
// Runs of a body in the default order under observation: its profile, its timeline.
#pragma once

#include "fibers/explore/body.hpp"
#include "fibers/explore/report/timeline.hpp"
#include "fibers/explore/strategies/profile.hpp"

namespace waitpoint::exploration {

/// Runs `body` in the default order and records its profile; returns the result.
RunVerdict take_profile(Body& body, Profile& profile);

/// Runs `body` in the default order and records its timeline.
Timeline take_timeline(Body& body);

}  // namespace waitpoint::exploration
