// SPDX-License-Identifier: BSD-3-Clause
// Solids that move, as a flat list with their bounding rectangles in eights: what a step changes costs next to nothing,
// and eight robots are culled as fast as one node of a tree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "world/planar/outline.hpp"
#include "world/slice/tree.hpp"

namespace waitpoint::world {

class MovingSolids {
 public:
  /// Numbered from `first_solid` on.
  explicit MovingSolids(std::span<const Shape> shapes, std::uint32_t first_solid = 0);

  std::size_t size() const { return solids_.size(); }
  std::uint32_t first_solid() const { return first_solid_; }
  const Outline& outline(std::size_t at) const { return solids_[at].outline; }
  bool reaches(std::size_t at, double height_m) const {
    return solids_[at].z_low_m <= height_m && height_m <= solids_[at].z_high_m;
  }
  /// Moves one; its heights stay, or are those.
  void place(std::size_t at, const Outline& outline);
  void place(std::size_t at, const Outline& outline, double z_low_m, double z_high_m);

  /// The rectangles of solids 8 i to 8 i + 7, in floats of the world's own coordinates.
  std::span<const EightBounds> bounds() const { return bounds_; }
  /// The greatest coordinate that any of them has had.
  double extent_m() const { return extent_m_; }

 private:
  struct Solid {
    Outline outline;
    double z_low_m, z_high_m;
  };
  std::uint32_t first_solid_;
  double extent_m_ = 0;
  std::vector<Solid> solids_;
  std::vector<EightBounds> bounds_;
};

}  // namespace waitpoint::world
