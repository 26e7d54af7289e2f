// SPDX-License-Identifier: BSD-3-Clause
#include "world/start_check.hpp"

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

}  // namespace waitpoint::world
