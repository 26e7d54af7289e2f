// SPDX-License-Identifier: BSD-3-Clause
// The places of the scan benchmark, the same in every run.
#pragma once

#include <string>
#include <vector>

#include "world/description.hpp"

namespace waitpoint::bench {

struct Place {
  std::string name;
  double length_m = 0, width_m = 0;  ///< from the origin
  std::vector<world::Shape> obstacles;
  std::vector<world::Shape> robots;  ///< discs, clear of each other and of the obstacles
  std::vector<Pose> stations;        ///< in free space: the first are the robots' own
  std::vector<world::MeshObstacle> meshes = {};
};

/// 40 x 30 m: rooms of 10 x 10 m with doors, furnished, 300 obstacles in all.
Place office(std::size_t robots);
/// 200 x 200 m: racks, pallets and columns, 5 000 obstacles.
Place warehouse(std::size_t robots);

/// 42 x 42 m: 49 rough obstacles, a mesh of 50 176 triangles.
Place mesh_hall();

/// The corners of an outline, counter-clockwise, for contenders without discs: sixteen on a disc.
std::vector<Point> corners(const world::Shape& shape);

}  // namespace waitpoint::bench
