// SPDX-License-Identifier: BSD-3-Clause
// The dynamic world, on Bullet: bodies have masses, drives have forces, and loose obstacles can be pushed.
//
//   latch    as in every world; a drive is to reach the velocity by the end of the step, within its forces
//   move     by Bullet, in parts of the step short enough for its contacts
//   publish  {pose, arc}: the arc from the previous pose to this one; it may be sideways
//   sense    as in every world, by the same code
//
// Sensors see a loose obstacle as an upright shape: exactly if one of its axes is vertical, else as its bounding box.
#pragma once

#include <cstdint>
#include <memory>

#include "world/kinematic/vehicle_world.hpp"

namespace waitpoint::world {

/// A world at its start; null if this library was built without Bullet. As for make_kinematic_world(), overlaps of
/// bodies are a bug here.
std::unique_ptr<VehicleWorld> make_bullet_world(const WorldDescription& description, std::uint64_t seed);

}  // namespace waitpoint::world
