// SPDX-License-Identifier: BSD-3-Clause
// The requests with which a mission begins: position, laser, localisation, tracking of the speed reference.
#pragma once

#include <optional>

#include "modules/genom/client.hpp"
#include "modules/posters/navigation.hpp"

namespace waitpoint::executive {

/// `start` is the robot's pose in the map frame; none: `locate` has to find it. A robot without localisation relies on
/// its odometry.
void start_modules(genom::Client& client, const genom::NameSpace& names,
                   const std::optional<posters::KnownPose>& start);

}  // namespace waitpoint::executive
