// SPDX-License-Identifier: BSD-3-Clause
// Worlds of Gazebo's SDF: their collision geometry.
//
//   <world>      <model>, <include>; the first one of a file
//   <model>      <pose>, <static>, <link>, <model>, <include>; fixed also if it is not static
//   <link>       <pose>, <collision>
//   <collision>  <pose>, <geometry>: <box>, <cylinder>, <sphere>, <mesh>; a level <plane> is the floor
//   <include>    <uri>, <name>, <pose>, <static>
//
// Poses are "x y z roll pitch yaw", each in the frame of the parent element. A solid becomes an upright shape
// (world/formats/upright.hpp), with a warning if it is tilted or a sphere. A <uri> is a path relative to the file, with
// or without "file://"; "model://NAME" is searched for beside the file, in the folder `models` there and in
// `../models`. In a model's folder, model.sdf is read. Models of model:// that are missing, those of other schemes
// (https://fuel...), and meshes with a missing or unsupported file are left out with a warning; a path that leads
// nowhere is an error.
//
// Everything else (<visual>, <inertial>, <light>, <state>, ...) is left out with a warning.
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

/// Reads the contents of an SDF file; `file` is its name, for messages and for includes. Obstacles and meshes have the
/// names of their models: "table", "table 1", ... for a model with several. BadInput, naming file and line, for
/// malformed XML or SDF, an invalid number or one beyond coordinate_m_max, a missing or recursive include, and for more
/// than obstacle_count_max obstacles.
SdfWorld parse_sdf(const std::string& contents, const std::string& file, LeftOut& left_out);

}  // namespace waitpoint::world
