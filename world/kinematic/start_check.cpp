// SPDX-License-Identifier: BSD-3-Clause
#include "world/kinematic/start_check.hpp"

#include <algorithm>
#include "world/mesh/surfaces.hpp"
#include "world/motion/first_contact.hpp"
#include "world/slice/footprints.hpp"

namespace waitpoint::world {
namespace {

bool meet(const Shape& shape_a, const Outline& a, const Shape& shape_b, const Outline& b) {
  return heights_overlap(shape_a, shape_b) && bounds_of(a).grown(contact_gap_m).overlaps(bounds_of(b)) &&
         separation(a, b).distance_m <= contact_gap_m;
}

}  // namespace

std::vector<StartOverlap> start_overlaps(const WorldDescription& description) {
  std::vector<Shape> obstacles, bodies;
  for (const Obstacle& obstacle : description.obstacles) obstacles.push_back(obstacle.shape);
  for (const BodyDescription& body : description.bodies) {
    bodies.push_back(raised(body.shape, body.start_height_m));
    bodies.back().pose = compose(body.start, body.shape.pose);
  }
  const Footprints of_obstacles(obstacles), of_bodies(bodies);
  const Surfaces of_meshes(description.meshes);
  std::vector<StartOverlap> overlaps;
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    const Shape& shape = bodies[i];
    const Outline outline = outline_of(description.bodies[i].shape, description.bodies[i].start);
    const Bounds bounds = bounds_of(outline);
    of_obstacles.near(bounds, 2 * contact_gap_m, shape.z_low_m, shape.z_high_m, near);
    for (const std::uint32_t obstacle : near) {
      if (meet(shape, outline, obstacles[obstacle], outline_of(obstacles[obstacle])))
        overlaps.push_back({description.bodies[i].name, description.obstacles[obstacle].name, false});
    }
    of_meshes.near(bounds.grown(2 * contact_gap_m), shape.z_low_m, shape.z_high_m, near);
    const auto first_met = std::find_if(near.begin(), near.end(), [&](std::uint32_t number) {
      return of_meshes.separation(outline, shape.z_low_m, shape.z_high_m, number).distance_m <= contact_gap_m;
    });
    if (first_met != near.end())
      overlaps.push_back({description.bodies[i].name, description.meshes[of_meshes.mesh(*first_met)].name, false});
    of_bodies.near(bounds, 2 * contact_gap_m, shape.z_low_m, shape.z_high_m, near);
    for (const std::uint32_t other : near) {
      const BodyDescription& body = description.bodies[other];
      if (other < i && meet(shape, outline, bodies[other], outline_of(body.shape, body.start)))
        overlaps.push_back({description.bodies[i].name, body.name, true});
    }
  }
  return overlaps;
}

bool overlap(const Shape& a, const Shape& b) {
  const bool in_height = std::min(a.z_high_m, b.z_high_m) - std::max(a.z_low_m, b.z_low_m) > loose_overlap_max_m;
  if (!in_height) return false;
  const Outline outline = outline_of(a), other = outline_of(b);
  return bounds_of(outline).overlaps(bounds_of(other)) && separation(outline, other).distance_m < -loose_overlap_max_m;
}

std::vector<LooseOverlap> loose_overlaps(const WorldDescription& description) {
  const std::vector<Obstacle>& all = description.obstacles;
  std::vector<LooseOverlap> overlaps;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].loose()) continue;
    for (std::size_t j = 0; j < all.size(); ++j) {
      // A pair of loose obstacles is reported once, under the first.
      const bool is_reported = j < i && all[j].loose();
      if (j != i && !is_reported && overlap(all[i].shape, all[j].shape)) overlaps.push_back({all[i].name, all[j].name});
    }
  }
  return overlaps;
}

}  // namespace waitpoint::world
