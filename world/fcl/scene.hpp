// SPDX-License-Identifier: BSD-3-Clause
// Solids in FCL's dynamic tree of bounding boxes.
//
// Each solid has two representations in FCL: its geometry (box, cylinder, convex) for the narrow phase, and a bounding
// box in the tree. Rays and candidates come from an own walk of that tree, since FCL 0.7 has no ray queries.
// Neighbouring rays of a fan walk it together, as a wedge: near child first, without nodes beside the wedge or beyond
// the farthest of the ranges found so far; every solid reached is tested against each ray.
//
// The boxes exceed the solids by more than any rounding, so that culling never loses a hit of hit_distance(): results
// equal those of a test of every solid, to the last bit, for any shape of the tree. Solids have their own numbers, and
// results are in that order.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "world/planar/ray.hpp"

namespace waitpoint::world {

class Scene {
 public:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;
  /// The padding of bounding boxes: far above the rounding of coordinates (1e-10 m even a thousand kilometres from the
  /// origin) and of a ray's entry into a box, far below a size that would cost time.
  static constexpr double padding_m = 1e-7;

  /// Solids are numbered from 0. `roam_m` widens the bounding boxes of solids that move, so that most moves leave the
  /// tree unchanged.
  explicit Scene(std::span<const Shape> shapes, double roam_m = 0);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  std::uint32_t size() const;
  const Outline& outline(std::uint32_t solid) const;
  /// True if the height is within the solid, its lower and upper face included.
  bool reaches(std::uint32_t solid, double height_m) const;

  /// Moves a solid, keeping its heights or with new ones.
  void place(std::uint32_t solid, const Outline& outline);
  void place(std::uint32_t solid, const Outline& outline, double z_low_m, double z_high_m);

  /// The solids whose bounding boxes overlap the bounds and whose open height intervals overlap (z_low_m, z_high_m), in
  /// ascending order; `found` is overwritten.
  void near(const Bounds& bounds, double z_low_m, double z_high_m, std::vector<std::uint32_t>& found) const;

  /// Casts a fan of rays, counter-clockwise, at one height: each of `ranges_m` is the limit of its ray, and is lowered
  /// to the distance of the nearest solid (other than `except`) if that is less. As many directions (of length 1) as
  /// ranges.
  void cast(Point origin, std::span<const Point> directions, double height_m, std::uint32_t except,
            std::span<double> ranges_m) const;

  /// True if a solid of that shape collides with any of the scene, by FCL's narrow phase.
  bool collides(const Shape& shape) const;

 private:
  struct Trees;
  std::unique_ptr<Trees> trees_;
};

}  // namespace waitpoint::world
