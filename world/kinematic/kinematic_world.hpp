// SPDX-License-Identifier: BSD-3-Clause
// The kinematic world. FCL's trees of bounding boxes, or own trees over slices and footprints, find candidates
// (WorldDescription::engine); the planar geometry of upright shapes decides.
#pragma once

#include <cstdint>
#include <memory>

#include "world/kinematic/vehicle_world.hpp"

namespace waitpoint::world {

/// A world at its start. A body that overlaps an obstacle or another body (see start_overlaps) is a bug here: readers
/// of descriptions report it as bad input.
std::unique_ptr<VehicleWorld> make_kinematic_world(const WorldDescription& description, std::uint64_t seed);

}  // namespace waitpoint::world
