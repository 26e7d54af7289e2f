// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <memory>

#include "core/random.hpp"
#include "tests/bench/world/places.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::bench {
namespace {

using world::SpaceVector;
using world::TriangleMesh;

constexpr std::uint32_t columns = 7, rows = 7;     // of obstacles
constexpr std::uint32_t sectors = 16, rings = 32;  // of each obstacle: 1 024 triangles
constexpr double square_m = 6, thing_radius_m = 1.2, thing_height_m = 2;
constexpr std::size_t stations = 200;

// An obstacle that rises from the floor, with a rough surface.
void add_thing(TriangleMesh& mesh, Point middle, const RandomStream& draw, std::uint64_t number) {
  const auto first = static_cast<std::uint32_t>(mesh.corners.size());
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    for (std::uint32_t sector = 0; sector < sectors; ++sector) {
      const auto [s, c] = exact::sincos(2 * exact::pi * sector / sectors);
      const double radius_m = thing_radius_m * (0.6 + 0.4 * draw.uniform(number, ring * sectors + sector));
      mesh.corners.push_back(
          {middle.x + radius_m * c, middle.y + radius_m * s, thing_height_m * static_cast<double>(ring) / rings});
    }
  }
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t sector = 0; sector < sectors; ++sector) {
      const std::uint32_t a = first + ring * sectors + sector, b = first + ring * sectors + (sector + 1) % sectors;
      mesh.triangles.push_back({a, b, b + sectors});
      mesh.triangles.push_back({a, b + sectors, a + sectors});
    }
  }
}

}  // namespace

Place mesh_hall() {
  Place place{"mesh", columns * square_m, rows * square_m, {}, {}, {}, {}};
  const RandomStream draw(1, place.name, "things"), where(1, place.name, "stations");
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < columns * rows; ++i)
    add_thing(mesh, {square_m * (i % columns + 0.5), square_m * (i / columns + 0.5)}, draw, i);
  place.meshes.push_back({place.name, std::make_shared<const TriangleMesh>(std::move(mesh))});
  // Along the aisles between obstacles.
  for (std::size_t i = 0; i < stations; ++i) {
    const double along_m = 1 + (place.length_m - 2) * where.uniform(i, 0);
    const double aisle_m = square_m * (1 + std::floor((columns - 1) * where.uniform(i, 1)));
    const double heading = exact::pi * (2 * where.uniform(i, 2) - 1);
    place.stations.push_back(i % 2 == 0 ? Pose{along_m, aisle_m, heading} : Pose{aisle_m, along_m, heading});
  }
  return place;
}

}  // namespace waitpoint::bench
