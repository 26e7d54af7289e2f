// SPDX-License-Identifier: BSD-3-Clause
// What a plan shows of a world's meshes: how they are cut at one height.
#pragma once

#include <vector>

#include "world/description.hpp"

namespace waitpoint::run {

/// The height of plans: that of the first laser there is, or half that of the first body.
double plan_height_m(const world::WorldDescription& world);

/// Each segment of the cut as a thin wall from the floor to the top of its mesh.
std::vector<world::Obstacle> meshes_on_plan(const world::WorldDescription& world);

}  // namespace waitpoint::run
