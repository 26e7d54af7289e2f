// SPDX-License-Identifier: BSD-3-Clause
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

TriangleMesh placed(TriangleMesh mesh, SpaceVector scale, const SpacePose& pose) {
  for (SpaceVector& corner : mesh.corners)
    corner = pose.position + pose.turned({scale.x * corner.x, scale.y * corner.y, scale.z * corner.z});
  return mesh;
}

}  // namespace waitpoint::world
