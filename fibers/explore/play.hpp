// SPDX-License-Identifier: BSD-3-Clause
// A token's schedule, once more.
#pragma once

#include "fibers/explore/body.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "fibers/explore/strategies/profile.hpp"

namespace waitpoint::exploration {

/// Runs the body by that token; by one of a strategy with the body's profile. Throws BadInput if the strategy does not
/// come as far.
Outcome play(Body& body, const Token& token, const Profile& profile);

}  // namespace waitpoint::exploration
