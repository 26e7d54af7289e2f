// SPDX-License-Identifier: BSD-3-Clause
// How strong a base's drive is in a dynamic world.
#pragma once

#include "world/bullet/drive_aim.hpp"

namespace waitpoint::world {

/// The forces that the drive of a body has; its velocity is left 0. By default twice what its greatest accelerations
/// take, but on the floor no more than its wheels grip.
DriveAim forces_of(const BodyDescription& body);

}  // namespace waitpoint::world
