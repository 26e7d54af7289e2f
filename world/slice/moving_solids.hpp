// SPDX-License-Identifier: BSD-3-Clause
// Solids that move, under a tree like that of those that stand, kept up with them.
//
// Neighbours lie side by side, eight to a node, eight nodes to one above, so the tree is full and has no shape of its
// own to keep: who moves sets his rectangle and those above it, up to the first that stays as it was. When the lowest
// nodes have become half as large again, for the neighbours have parted, all are ordered anew.
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
  /// Numbered from `first_solid` on.
  explicit MovingSolids(std::span<const Shape> shapes, std::uint32_t first_solid = 0);

  std::size_t size() const { return solids_.size(); }
  std::uint32_t first_solid() const { return first_solid_; }
  const Outline& outline(std::size_t at) const { return solids_[at].outline; }
  bool reaches(std::size_t at, double height_m) const {
    return solids_[at].z_low_m <= height_m && height_m <= solids_[at].z_high_m;
  }
  double z_low_m(std::size_t at) const { return solids_[at].z_low_m; }
  double z_high_m(std::size_t at) const { return solids_[at].z_high_m; }
  /// Moves one; its heights stay, or are those.
  void place(std::size_t at, const Outline& outline);
  void place(std::size_t at, const Outline& outline, double z_low_m, double z_high_m);

  /// Those whose bounds overlap these, and perhaps a few that only nearly do, in ascending order; `found` is
  /// overwritten.
  void near(const Bounds& bounds, std::vector<std::uint32_t>& found, const Kernels& of = kernels()) const;

  /// The tree, its root first; in floats of the world's own coordinates. Its leaves are places in this list.
  std::span<const TreeNode> nodes() const { return nodes_; }
  /// Overwrites `places` with the places in this list as the leaves have them: neighbours side by side.
  void list_by_leaves(std::vector<std::uint32_t>& places) const;
  /// The greatest coordinate that any of them has had.
  double extent_m() const { return extent_m_; }

 private:
  struct Solid {
    Outline outline;
    double z_low_m, z_high_m;
    std::uint32_t place;  // among the leaves
  };

  void order();
  void order(std::span<std::uint32_t> group) const;
  void set_leaf(std::size_t at);
  bool set_above(std::size_t level, std::size_t node);
  double spread_m() const;

  std::uint32_t first_solid_;
  std::vector<std::shared_ptr<const ConvexPolygon>> polygons_;  // of the outlines
  double extent_m_ = 0;
  std::vector<Solid> solids_;
  std::vector<TreeNode> nodes_;
  std::vector<std::size_t> levels_;  // the first node of each, from the root down
  double ordered_spread_m_ = 0;      // when they were ordered last
  std::size_t placed_ = 0;           // since the spread was looked at
};

}  // namespace waitpoint::world
