// SPDX-License-Identifier: BSD-3-Clause
// Builds a mesh corner by corner, with the limits and warnings shared by all mesh formats.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "world/formats/left_out.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

class MeshBuilder {
 public:
  MeshBuilder(const std::string& file, LeftOut& left_out) : file_(file), left_out_(left_out) {}

  /// BadInput at that line (0 for a file without lines) for coordinates that are not finite or too large.
  void add_corner(const SpaceVector& corner, int line);
  /// The same from the first three words of a line; further words are ignored. The message of BadInput begins with
  /// `expected` if they are not numbers.
  void read_corner(std::string_view line, int number, const std::string& expected);
  std::size_t corner_count() const { return mesh_.corners.size(); }

  /// Adds a triangle of corners already added. A triangle without area is left out, with a warning. BadInput beyond
  /// triangle_count_max.
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, int line);

  /// BadInput if there is no triangle.
  TriangleMesh mesh();

  [[noreturn]] void fail(int line, const std::string& message) const;

 private:
  const std::string& file_;
  LeftOut& left_out_;
  TriangleMesh mesh_;
};

}  // namespace waitpoint::world
