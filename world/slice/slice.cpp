// SPDX-License-Identifier: BSD-3-Clause
#include "world/slice/slice.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace waitpoint::world {
namespace {

std::vector<std::uint32_t> reaching(std::span<const Shape> shapes, double height_m) {
  std::vector<std::uint32_t> solids;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    if (reaches(shapes[i], height_m)) solids.push_back(i);
  }
  return solids;
}

std::vector<Outline> outlines_of(std::span<const Shape> shapes, std::span<const std::uint32_t> solids) {
  std::vector<Outline> outlines;
  for (const std::uint32_t solid : solids) outlines.push_back(outline_of(shapes[solid]));
  return outlines;
}

std::vector<Bounds> bounds_of_all(std::span<const Outline> outlines) {
  std::vector<Bounds> bounds;
  for (const Outline& outline : outlines) bounds.push_back(bounds_of(outline));
  return bounds;
}

}  // namespace

Slice::Slice(std::span<const Shape> shapes, double height_m, std::span<const Outline> others,
             std::span<const std::uint32_t> solids_of_others)
    : height_m_(height_m), polygons_(polygons_of(shapes)), tree_(std::span<const Bounds>()) {
  WAITPOINT_CHECK(others.size() == solids_of_others.size(), "a slice has not one solid for each further outline");
  std::vector<std::uint32_t> solids = reaching(shapes, height_m);
  std::vector<Outline> outlines = outlines_of(shapes, solids);
  outlines.insert(outlines.end(), others.begin(), others.end());
  solids.insert(solids.end(), solids_of_others.begin(), solids_of_others.end());
  WAITPOINT_CHECK(std::none_of(outlines.begin(), outlines.end(), [](const Outline& o) { return o.is_triangle; }),
                  "a slice has a triangle, which no beam is tested against");
  tree_ = Tree(bounds_of_all(outlines));
  for (const std::uint32_t number : tree_.number_by_nodes()) {
    outlines_.push_back(outlines[number]);
    solids_.push_back(solids[number]);
  }
  WAITPOINT_CHECK(outlines_.size() == outlines.size(), "a slice's tree has lost an outline");
}

}  // namespace waitpoint::world
