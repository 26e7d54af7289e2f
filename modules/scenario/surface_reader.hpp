// SPDX-License-Identifier: BSD-3-Clause
// Shapes of a scenario from files: a mesh, or the occupied cells of an octree.
//
//   {mesh: hall.stl, at_m: [2, 3, 0], heading_deg: 90, scale: 0.001}      scale: a number, or one for each axis
//   {octomap: yard.bt, at_m: [2, 3], heading_deg: 90}
#pragma once

#include <string>
#include <vector>

#include "modules/scenario/keys.hpp"
#include "world/description.hpp"
#include "world/formats/left_out.hpp"

namespace waitpoint::scenario {

const KeyTable& mesh_keys();
const KeyTable& octomap_keys();

/// Omitted parts of the file are added to `left_out`. BadInput as from world::read_mesh_file().
world::MeshObstacle read_mesh(const YamlNode& node, const std::string& name, world::LeftOut& left_out);

/// Boxes named "NAME 0", "NAME 1", .... BadInput as from world::read_octree().
std::vector<world::Obstacle> read_octomap(const YamlNode& node, const std::string& name, world::LeftOut& left_out);

}  // namespace waitpoint::scenario
