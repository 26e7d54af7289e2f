// SPDX-License-Identifier: BSD-3-Clause
// The kinematic world on FCL: its trees of bounding boxes find what is near, the planar geometry of upright shapes
// decides. Planar beams can go through slices instead (WorldDescription::engine).
#pragma once

#include <cstdint>
#include <memory>

#include "world/world.hpp"

namespace waitpoint::world {

/// A world at its start. A body that overlaps an obstacle or another body (see start_overlaps) is a bug here: whoever
/// read the description reports it as bad input.
std::unique_ptr<World> make_kinematic_world(const WorldDescription& description, std::uint64_t seed);

}  // namespace waitpoint::world
