// SPDX-License-Identifier: BSD-3-Clause
// Triangle meshes in space, read from mesh files, as obstacles.
//
// A mesh is a shell, not a solid: only its triangles obstruct, its interior is free. So robots can drive inside a
// building's mesh.
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
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `corners`

  Triangle triangle(std::size_t number) const {
    const std::array<std::uint32_t, 3>& of = triangles[number];
    return {{corners[of[0]], corners[of[1]], corners[of[2]]}};
  }
};

/// A fixed mesh, corners in the world's frame. Shared, since worlds are copied.
struct MeshObstacle {
  std::string name;
  std::shared_ptr<const TriangleMesh> mesh;
  bool known = true;  ///< in the map given to planners
};

/// The mesh scaled along its own axes, then placed at `pose`.
TriangleMesh placed(TriangleMesh mesh, SpaceVector scale, const SpacePose& pose);

}  // namespace waitpoint::world
