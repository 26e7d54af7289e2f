// SPDX-License-Identifier: BSD-3-Clause
// The forces of a base's drive in a dynamic world.
#pragma once

#include "world/bullet/drive_aim.hpp"

namespace waitpoint::world {

/// The limits of the forces of a body's drive; the velocity is 0. By default twice the forces of its greatest
/// accelerations; on the floor at most the grip of its wheels.
DriveAim forces_of(const BodyDescription& body);

}  // namespace waitpoint::world
