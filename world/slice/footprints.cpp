// SPDX-License-Identifier: BSD-3-Clause
#include "world/slice/footprints.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "core/error.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::world {
namespace {

Tree tree_over(std::span<const Shape> shapes) {
  std::vector<Bounds> bounds;
  for (const Shape& shape : shapes) bounds.push_back(bounds_of(outline_of(shape)));
  return Tree(bounds);
}

}  // namespace

Footprints::Footprints(std::span<const Shape> shapes, const Kernels& of) : kernels_(&of), tree_(tree_over(shapes)) {
  for (const Shape& shape : shapes) {
    const Outline outline = outline_of(shape);
    solids_.push_back({outline, bounds_of(outline), shape.z_low_m, shape.z_high_m});
  }
}

// Shows `visit` a few solids more than those whose bounds overlap these, until it returns false.
template <class Visit>
void Footprints::visit(const Bounds& bounds, Visit visit) const {
  if (tree_.empty()) return;
  const Bounds b = {bounds.low - tree_.middle(), bounds.high - tree_.middle()};
  // Where the tree ends nothing is missed: what is beyond it by more than a float can be is beyond it all the same.
  const double margin_m = float_margin_m(tree_.extent_m());
  const FloatBounds wanted = {static_cast<float>(b.low.x - margin_m), static_cast<float>(b.low.y - margin_m),
                              static_cast<float>(b.high.x + margin_m), static_cast<float>(b.high.y + margin_m)};
  std::array<std::int32_t, 512> pending;
  std::size_t count = 0;
  pending[count++] = 0;
  while (count > 0) {
    const TreeNode& node = tree_.node(pending[--count]);
    for (unsigned met = kernels_->overlap(node.bounds, wanted); met != 0; met &= met - 1) {
      const std::int32_t child = node.child[static_cast<std::size_t>(std::countr_zero(met))];
      if (child >= 0) {
        WAITPOINT_CHECK(count < pending.size(), "a tree of solids far out of balance");
        pending[count++] = child;
      } else if (!visit(static_cast<std::uint32_t>(~child))) {
        return;
      }
    }
  }
}

void Footprints::near(const Bounds& bounds, double margin_m, double z_low_m, double z_high_m,
                      std::vector<std::uint32_t>& found) const {
  found.clear();
  visit(bounds.grown(margin_m), [&](std::uint32_t number) {
    const Solid& solid = solids_[number];
    if (solid.shares_height(z_low_m, z_high_m) && bounds.overlaps(solid.bounds.grown(margin_m)))
      found.push_back(number);
    return true;
  });
  std::sort(found.begin(), found.end());
}

bool Footprints::collides(const Outline& outline, double z_low_m, double z_high_m) const {
  bool met = false;
  visit(bounds_of(outline), [&](std::uint32_t number) {
    const Solid& solid = solids_[number];
    met = solid.shares_height(z_low_m, z_high_m) && separation(outline, solid.outline).distance_m < 0;
    return !met;
  });
  return met;
}

}  // namespace waitpoint::world
