// SPDX-License-Identifier: BSD-3-Clause
#include "world/slice/moving_solids.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::world {

MovingSolids::MovingSolids(std::span<const Shape> shapes, std::uint32_t first_solid) : first_solid_(first_solid) {
  bounds_.assign((shapes.size() + EightBounds::width - 1) / EightBounds::width, EightBounds::nowhere());
  for (const Shape& shape : shapes) {
    solids_.push_back({{}, shape.z_low_m, shape.z_high_m});
    place(solids_.size() - 1, outline_of(shape));
  }
}

void MovingSolids::place(std::size_t at, const Outline& outline) {
  solids_[at].outline = outline;
  const Bounds b = bounds_of(outline);
  const double farthest = std::max({std::fabs(b.low.x), std::fabs(b.low.y), std::fabs(b.high.x), std::fabs(b.high.y)});
  extent_m_ = std::max(extent_m_, farthest);
  bounds_[at / EightBounds::width].set(static_cast<int>(at % EightBounds::width), b, {0, 0}, float_margin_m(farthest));
}

void MovingSolids::place(std::size_t at, const Outline& outline, double z_low_m, double z_high_m) {
  solids_[at].z_low_m = z_low_m;
  solids_[at].z_high_m = z_high_m;
  place(at, outline);
}

}  // namespace waitpoint::world
