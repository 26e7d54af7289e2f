// SPDX-License-Identifier: BSD-3-Clause
// Helpers to make meshes for tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/world/scenes.hpp"
#include "world/mesh/surfaces.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

inline MeshObstacle mesh_obstacle(const std::string& name, TriangleMesh mesh) {
  return {name, std::make_shared<const TriangleMesh>(std::move(mesh))};
}

inline void add_triangle(TriangleMesh& mesh, const SpaceVector& a, const SpaceVector& b, const SpaceVector& c) {
  const auto first = static_cast<std::uint32_t>(mesh.corners.size());
  mesh.corners.insert(mesh.corners.end(), {a, b, c});
  mesh.triangles.push_back({first, first + 1, first + 2});
}

/// Two triangles; the corners in order around.
inline void add_quad(TriangleMesh& mesh, const SpaceVector& a, const SpaceVector& b, const SpaceVector& c,
                     const SpaceVector& d) {
  add_triangle(mesh, a, b, c);
  add_triangle(mesh, a, c, d);
}

/// The surface of an upright box between two corners.
inline TriangleMesh box_mesh(const SpaceVector& low, const SpaceVector& high) {
  TriangleMesh mesh;
  const auto corner = [&](int x, int y, int z) {
    return SpaceVector{x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z};
  };
  for (const int side : {0, 1}) {
    add_quad(mesh, corner(side, 0, 0), corner(side, 1, 0), corner(side, 1, 1), corner(side, 0, 1));
    add_quad(mesh, corner(0, side, 0), corner(1, side, 0), corner(1, side, 1), corner(0, side, 1));
    add_quad(mesh, corner(0, 0, side), corner(1, 0, side), corner(1, 1, side), corner(0, 1, side));
  }
  return mesh;
}

/// Triangles in a square about the origin, from the floor to `high_m`: tilted ones, some upright, some level.
inline TriangleMesh random_triangles(Draws& draw, int count, double half_square_m, double size_m, double high_m) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const double x = draw(-half_square_m, half_square_m), y = draw(-half_square_m, half_square_m);
    const auto corner = [&] {
      const double dx = draw(-size_m, size_m), dy = draw(-size_m, size_m);
      return SpaceVector{x + dx, y + dy, draw(0, high_m)};
    };
    SpaceVector a = corner(), b = corner(), c = corner();
    if (i % 5 == 0) b.z = c.z = a.z;
    if (i % 5 == 1) {
      c.x = b.x;
      c.y = b.y;
    }
    add_triangle(mesh, a, b, c);
  }
  return mesh;
}

/// A closed surface about the origin: an octahedron of that radius, its sides halved repeatedly, its corners moved in
/// and out at random. Some of its corners are exactly at height 0.
inline TriangleMesh lumpy_ball(Draws& draw, int halvings, double radius_m) {
  std::vector<SpaceVector> corners = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < 4; ++i) {
    triangles.push_back({i, (i + 1) % 4, 4});
    triangles.push_back({(i + 1) % 4, i, 5});
  }
  for (int k = 0; k < halvings; ++k) {
    std::vector<std::array<std::uint32_t, 3>> finer;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, is_new] = middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(corners.size()));
      if (is_new) corners.push_back(0.5 * (corners[a] + corners[b]));
      return place->second;
    };
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = finer;
  }
  for (SpaceVector& corner : corners) {
    const double length = std::sqrt(corner.x * corner.x + corner.y * corner.y + corner.z * corner.z);
    corner = (radius_m * draw(0.9, 1.1) / length) * corner;
  }
  return {corners, triangles};
}

/// The distance of a body from the nearest triangle.
inline double nearest_m(const Surfaces& surfaces, const Outline& outline, double z_low_m, double z_high_m) {
  double nearest = HUGE_VAL;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i)
    nearest = std::min(nearest, surfaces.separation(outline, z_low_m, z_high_m, i).distance_m);
  return nearest;
}

}  // namespace waitpoint::world
