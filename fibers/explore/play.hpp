// SPDX-License-Identifier: BSD-3-Clause
// Replays a token's schedule.
#pragma once

#include "fibers/explore/body.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "fibers/explore/strategies/profile.hpp"

namespace waitpoint::exploration {

/// Runs the body by that token; a token of a strategy needs the body's profile. Throws BadInput if the strategy ends
/// before the token's number.
RunVerdict play(Body& body, const Token& token, const Profile& profile);

}  // namespace waitpoint::exploration
