// SPDX-License-Identifier: BSD-3-Clause
#include "world/kinematic/vehicle_world.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "world/kinematic/start_check.hpp"
#include "world/motion/contact_loop.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::world {

VehicleWorld::VehicleWorld(const WorldDescription& description, std::span<const Shape> standing,
                           std::span<const Shape> movers)
    : description_(description), step_s_(description.step.seconds()), senses_(description_, standing, movers) {
  WAITPOINT_CHECK(step_s_ > 0, "a world has no positive period");
  WAITPOINT_CHECK(start_overlaps(description_).empty(), "a body starts inside something solid");
}

std::size_t VehicleWorld::find_obstacle(const std::string& name) const {
  const std::vector<Obstacle>& all = description_.obstacles;
  const auto found = std::find_if(all.begin(), all.end(), [&](const Obstacle& other) { return other.name == name; });
  return static_cast<std::size_t>(found - all.begin());
}

std::optional<std::string> VehicleWorld::body_met(const Shape& shape, const Outline& outline,
                                                  std::uint32_t except) const {
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) {
    const Vehicle& other = vehicles_[i];
    if (i != except && heights_overlap(shape, other.shape()) &&
        separation(outline, other.outline()).distance_m <= contact_gap_m)
      return other.description().name;
  }
  return std::nullopt;
}

std::optional<std::string> VehicleWorld::mesh_met(const Shape& shape, const Outline& outline) const {
  const Surfaces& surfaces = senses_.surfaces();
  std::vector<std::uint32_t> near;
  surfaces.near(bounds_of(outline).grown(2 * contact_gap_m), shape.z_low_m, shape.z_high_m, near);
  for (const std::uint32_t number : near) {
    if (surfaces.separation(outline, shape.z_low_m, shape.z_high_m, number).distance_m <= contact_gap_m)
      return description_.meshes[surfaces.mesh(number)].name;
  }
  return std::nullopt;
}

}  // namespace waitpoint::world
