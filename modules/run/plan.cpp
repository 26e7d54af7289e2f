// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/plan.hpp"

#include <algorithm>

#include "world/formats/segments.hpp"
#include "world/mesh/section.hpp"

namespace waitpoint::run {

double plan_height_m(const world::WorldDescription& world) {
  for (const world::BodyDescription& body : world.bodies)
    if (!body.sensors<world::Lasers>().empty())
      return body.sensors<world::Lasers>().front().height_m + body.start_height_m;
  if (world.bodies.empty()) return 0.5;
  const world::BodyDescription& first = world.bodies.front();
  return 0.5 * (first.shape.z_low_m + first.shape.z_high_m) + first.start_height_m;
}

std::vector<world::Obstacle> meshes_on_plan(const world::WorldDescription& world) {
  const double height_m = plan_height_m(world);
  std::vector<world::Obstacle> walls;
  for (const world::MeshObstacle& mesh : world.meshes) {
    double top_m = 0;
    for (const world::SpaceVector& corner : mesh.mesh->corners) top_m = std::max(top_m, corner.z);
    for (std::size_t i = 0; i < mesh.mesh->triangles.size(); ++i) {
      const auto segment = world::cut(mesh.mesh->triangle(i), height_m);
      if (!segment) continue;
      const world::CorePoints ends = world::core_points(*segment);
      walls.push_back({mesh.name, world::wall_between(ends[1], ends[0], 0, top_m), mesh.known});
    }
  }
  return walls;
}

}  // namespace waitpoint::run
