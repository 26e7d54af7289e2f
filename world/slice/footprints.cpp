// SPDX-License-Identifier: BSD-3-Clause
#include "world/slice/footprints.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "world/planar/separation.hpp"
#include "world/slice/overlap_walk.hpp"

namespace waitpoint::world {
namespace {

Tree tree_over(std::span<const Shape> shapes) {
  std::vector<Bounds> bounds;
  for (const Shape& shape : shapes) bounds.push_back(bounds_of(outline_of(shape)));
  return Tree(bounds);
}

}  // namespace

Footprints::Footprints(std::span<const Shape> shapes, const Kernels& of)
    : kernels_(&of), polygons_(polygons_of(shapes)), tree_(tree_over(shapes)) {
  for (const Shape& shape : shapes) {
    WAITPOINT_CHECK(shape.z_low_m <= shape.z_high_m, "a solid ends below its lower face");
    const Outline outline = outline_of(shape);
    solids_.push_back({outline, bounds_of(outline), shape.z_low_m, shape.z_high_m});
  }
}

// Calls `visit(solid)` for the solids whose bounds overlap these, and possibly a few more, until it returns false.
template <class Visit>
void Footprints::visit(const Bounds& bounds, Visit visit) const {
  walk_overlapping(tree_.nodes(), {bounds.low - tree_.middle(), bounds.high - tree_.middle()},
                   float_margin_m(tree_.extent_m()), *kernels_, visit);
}

void Footprints::near(const Bounds& bounds, double margin_m, double z_low_m, double z_high_m,
                      std::vector<std::uint32_t>& found) const {
  WAITPOINT_FAST_CHECK(margin_m >= 0 && z_low_m <= z_high_m, "a query of footprints has a negative margin or height");
  found.clear();
  visit(bounds.grown(margin_m), [&](std::uint32_t number) {
    WAITPOINT_FAST_CHECK(number < solids_.size(), "the tree of footprints has a solid too many");
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
