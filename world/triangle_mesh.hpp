// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of triangles in space: what a mesh file says that stands in a world.
//
// A mesh is a shell, not a solid: only its triangles are in the way, and what is inside of it is free. So a building's
// mesh can be driven in.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "world/space_pose.hpp"

namespace waitpoint::world {

struct Triangle {
  std::array<SpaceVector, 3> corners;

  double low_m() const { return std::min({corners[0].z, corners[1].z, corners[2].z}); }
  double high_m() const { return std::max({corners[0].z, corners[1].z, corners[2].z}); }
};

struct TriangleMesh {
  std::vector<SpaceVector> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< by their corners

  Triangle triangle(std::size_t number) const {
    const std::array<std::uint32_t, 3>& of = triangles[number];
    return {{corners[of[0]], corners[of[1]], corners[of[2]]}};
  }
};

/// A mesh that stands: its corners are in the world's frame. It is shared, for worlds are copied.
struct MeshObstacle {
  std::string name;
  std::shared_ptr<const TriangleMesh> mesh;
  bool known = true;  ///< whether the map given to planners shows it
};

/// The mesh, each of its axes that many times as long, then placed at `pose`.
TriangleMesh placed(TriangleMesh mesh, SpaceVector scale, const SpacePose& pose);

}  // namespace waitpoint::world
