// SPDX-License-Identifier: BSD-3-Clause
// A mesh as it is read, corner by corner: what all mesh formats refuse and leave out alike.
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

  /// BadInput at that line (0: of a file without lines) for coordinates that are no numbers or too large.
  void add_corner(const SpaceVector& corner, int line);
  /// The same of three words of a line; more may come behind. BadInput begins with `expected` where they are no
  /// numbers.
  void read_corner(std::string_view line, int number, const std::string& expected);
  std::size_t corner_count() const { return mesh_.corners.size(); }

  /// Of corners that are there. One without area is left out, and told. BadInput for one too many.
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
