// SPDX-License-Identifier: BSD-3-Clause
// Moving solids under a tree of rectangles like that of the fixed ones (tree.hpp), updated with each move.
//
// Neighbours are adjacent, eight per node, eight nodes per parent, so the tree is full and its shape is constant: a
// move updates the solid's rectangle and its ancestors', up to the first that does not change. When the lowest nodes
// have grown by half, since neighbours have moved apart, all solids are reordered.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "world/planar/outline.hpp"
#include "world/slice/kernels.hpp"
#include "world/slice/tree.hpp"

namespace waitpoint::world {

class MovingSolids {
 public:
  /// Solids are numbered from `first_solid`, in the order of `shapes`. `at` below is the index in that order.
  explicit MovingSolids(std::span<const Shape> shapes, std::uint32_t first_solid = 0);

  std::size_t size() const { return solids_.size(); }
  std::uint32_t first_solid() const { return first_solid_; }
  const Outline& outline(std::size_t at) const { return solids_[at].outline; }
  bool reaches(std::size_t at, double height_m) const {
    return solids_[at].z_low_m <= height_m && height_m <= solids_[at].z_high_m;
  }
  double z_low_m(std::size_t at) const { return solids_[at].z_low_m; }
  double z_high_m(std::size_t at) const { return solids_[at].z_high_m; }
  /// Moves a solid, keeping its heights (m) or with new ones.
  void place(std::size_t at, const Outline& outline);
  void place(std::size_t at, const Outline& outline, double z_low_m, double z_high_m);

  /// The indices of the solids whose bounds overlap these, and possibly a few that only nearly do, in ascending order;
  /// `found` is overwritten.
  void near(const Bounds& bounds, std::vector<std::uint32_t>& found, const Kernels& of = kernels()) const;

  /// The tree, root first, in the world's coordinates as floats. Its leaves are indices of solids.
  std::span<const TreeNode> nodes() const { return nodes_; }
  /// Overwrites `places` with the indices of all solids in the order of the leaves: neighbours are adjacent.
  void list_by_leaves(std::vector<std::uint32_t>& places) const;
  /// The greatest magnitude of a coordinate so far, of any solid.
  double extent_m() const { return extent_m_; }

 private:
  struct Solid {
    Outline outline;
    double z_low_m, z_high_m;
    std::uint32_t place;  // position among the leaves
  };

  void order();
  void order(std::span<std::uint32_t> group) const;
  void set_leaf(std::size_t at);
  bool set_above(std::size_t level, std::size_t node);
  double spread_m() const;
  bool is_consistent() const;

  std::uint32_t first_solid_;
  std::vector<std::shared_ptr<const ConvexPolygon>> polygons_;  // of the outlines
  double extent_m_ = 0;
  std::vector<Solid> solids_;
  std::vector<TreeNode> nodes_;
  std::vector<std::size_t> levels_;  // the first node of each, from the root down
  double ordered_spread_m_ = 0;      // spread_m() at the last reordering
  std::size_t placed_ = 0;           // moves since the last check of the spread
};

}  // namespace waitpoint::world
