// SPDX-License-Identifier: BSD-3-Clause
// Runs of a body in the default order under observation: its profile, its timeline.
#pragma once

#include "fibers/explore/body.hpp"
#include "fibers/explore/report/timeline.hpp"
#include "fibers/explore/strategies/profile.hpp"

namespace waitpoint::exploration {

/// Runs `body` in the default order and records its profile; returns the result, of the first run that fails if there
/// are several.
RunVerdict take_profile(Body& body, Profile& profile);

/// Runs `body` in the default order and records its timeline; returns the result.
RunVerdict take_timeline(Body& body, Timeline& timeline);

}  // namespace waitpoint::exploration
