// SPDX-License-Identifier: BSD-3-Clause
// Plan view of a world's meshes: their cross-section at one height.
#pragma once

#include <vector>

#include "world/description.hpp"

namespace waitpoint::run {

/// The height of the cross-section: that of the first laser, or half that of the first body if there is none.
double plan_height_m(const world::WorldDescription& world);

/// Each segment of the cross-section as a thin wall from the floor to the top of its mesh.
std::vector<world::Obstacle> meshes_on_plan(const world::WorldDescription& world);

}  // namespace waitpoint::run
