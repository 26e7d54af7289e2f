// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/mesh_builder.hpp"

#include <array>
#include <utility>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "world/formats/limits.hpp"
#include "world/formats/line_words.hpp"

namespace waitpoint::world {
namespace {

SpaceVector cross(const SpaceVector& a, const SpaceVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace

void MeshBuilder::fail(int line, const std::string& message) const {
  if (line > 0) throw BadInput(file_, line, message);
  throw BadInput(file_, message);
}

void MeshBuilder::add_corner(const SpaceVector& corner, int line) {
  // A bound for files with unused corners.
  constexpr std::size_t corner_count_max = 3 * triangle_count_max;
  if (!corner.is_within(mesh_coordinate_max)) fail(line, "expected coordinates of corners to be numbers up to 1e9");
  if (mesh_.corners.size() == corner_count_max)
    fail(line, "expected at most " + std::to_string(corner_count_max) + " corners");
  mesh_.corners.push_back(corner);
}

void MeshBuilder::read_corner(std::string_view line, int number, const std::string& expected) {
  std::array<double, 3> values{};
  for (double& value : values) {
    std::string_view word = take_word(line);
    if (word.starts_with('+')) word.remove_prefix(1);
    if (!parse_number(word, value)) fail(number, expected + ", found " + shown(word));
  }
  add_corner({values[0], values[1], values[2]}, number);
}

void MeshBuilder::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, int line) {
  const SpaceVector &p = mesh_.corners[a], &q = mesh_.corners[b], &r = mesh_.corners[c];
  const SpaceVector area = cross(q + -1 * p, r + -1 * p);
  if (area.x == 0 && area.y == 0 && area.z == 0) {
    left_out_.add(file_, line, "a triangle without area", "is left out");
    return;
  }
  if (mesh_.triangles.size() == triangle_count_max)
    fail(line, "expected at most " + std::to_string(triangle_count_max) + " triangles");
  mesh_.triangles.push_back({a, b, c});
}

TriangleMesh MeshBuilder::mesh() {
  if (mesh_.triangles.empty()) fail(0, "expected triangles that have an area, found none");
  return std::move(mesh_);
}

}  // namespace waitpoint::world
