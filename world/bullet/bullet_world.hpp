// SPDX-License-Identifier: BSD-3-Clause
// The dynamic world, on Bullet: bodies have masses, drives have forces, and what is loose can be pushed.
//
//   latch    as in every world; a drive is to reach the velocity by the end of the step, with the force that it has
//   move     by Bullet, in parts of the step that are short enough for its contacts
//   publish  {pose, arc}: the arc is that on which the body came from where it was; it may go sideways
//   sense    as in every world, by the same code
//
// What is loose is to sensors an upright shape: itself where one of its axes is vertical, the box about it while it
// tips.
#pragma once

#include <cstdint>
#include <memory>

#include "world/world.hpp"

namespace waitpoint::world {

/// A world at its start; null where this library was built without Bullet. As for make_kinematic_world(), bodies that
/// overlap something are a bug here.
std::unique_ptr<World> make_bullet_world(const WorldDescription& description, std::uint64_t seed);

}  // namespace waitpoint::world
