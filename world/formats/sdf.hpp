// SPDX-License-Identifier: BSD-3-Clause
// Worlds of Gazebo's SDF: what collides in them.
//
//   <world>      <model>, <include>; the first one of a file
//   <model>      <pose>, <static>, <link>, <model>, <include>; one that is not static stands still
//   <link>       <pose>, <collision>
//   <collision>  <pose>, <geometry>: <box>, <cylinder>, <sphere>, <mesh>; a level <plane> is the floor
//   <include>    <uri>, <name>, <pose>, <static>
//
// Poses are "x y z roll pitch yaw", each in the frame of what holds it. A solid becomes an upright shape
// (world/formats/upright.hpp); one that is not upright, and a sphere, is told. A <uri> is a path relative to the file,
// also behind "file://"; "model://NAME" is looked for beside the file, in the folder `models` there and in `../models`,
// and "model://sun", "model://ground_plane", which are in every world, may be missing. Of a model's folder, model.sdf
// is read. A mesh whose file is missing, or of a kind that this program does not read, is left out and told.
//
// Everything else (<visual>, <inertial>, <light>, <state>, ...) is left out and told.
#pragma once

#include <string>
#include <vector>

#include "world/description.hpp"
#include "world/formats/left_out.hpp"

namespace waitpoint::world {

struct SdfWorld {
  std::vector<Obstacle> obstacles;
  std::vector<MeshObstacle> meshes;
};

/// Reads the contents of an SDF file; `file` is its name, for messages and for what it includes. Obstacles and meshes
/// bear the names of their models: "table", "table 1", ... for a model of several. BadInput, naming file and line, for
/// what is no XML or no SDF, a number that is none or beyond coordinate_m_max, an include that is missing or of itself,
/// and for more than obstacle_count_max obstacles.
SdfWorld parse_sdf(const std::string& contents, const std::string& file, LeftOut& left_out);

}  // namespace waitpoint::world
