// SPDX-License-Identifier: BSD-3-Clause
#include "world/start_check.hpp"

#include <algorithm>

#include "world/motion/first_contact.hpp"

namespace waitpoint::world {
namespace {

bool meet(const Shape& shape_a, const Outline& a, const Shape& shape_b, const Outline& b) {
  return heights_overlap(shape_a, shape_b) && bounds_of(a).grown(contact_gap_m).overlaps(bounds_of(b)) &&
         separation(a, b).distance_m <= contact_gap_m;
}

}  // namespace

std::vector<StartOverlap> start_overlaps(const WorldDescription& description) {
  std::vector<StartOverlap> overlaps;
  std::vector<Outline> bodies;
  for (const BodyDescription& body : description.bodies) {
    const Outline outline = outline_of(body.shape, body.start);
    const Shape shape = raised(body.shape, body.start_height_m);
    for (const Obstacle& obstacle : description.obstacles) {
      if (meet(shape, outline, obstacle.shape, outline_of(obstacle.shape))) {
        overlaps.push_back({body.name, obstacle.name, false});
      }
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const BodyDescription& other = description.bodies[i];
      if (meet(shape, outline, raised(other.shape, other.start_height_m), bodies[i]))
        overlaps.push_back({body.name, other.name, true});
    }
    bodies.push_back(outline);
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
      // Of two that are loose, the first is told.
      const bool told = j < i && all[j].loose();
      if (j != i && !told && overlap(all[i].shape, all[j].shape)) overlaps.push_back({all[i].name, all[j].name});
    }
  }
  return overlaps;
}

}  // namespace waitpoint::world
