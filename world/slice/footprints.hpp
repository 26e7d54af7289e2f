// SPDX-License-Identifier: BSD-3-Clause
// Fixed upright solids seen from above, all heights together: finds the solids that an upright body is near or collides
// with.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "world/planar/outline.hpp"
#include "world/slice/kernels.hpp"
#include "world/slice/tree.hpp"

namespace waitpoint::world {

class Footprints {
 public:
  /// Solids are numbered from 0, in the order of `shapes`.
  explicit Footprints(std::span<const Shape> shapes, const Kernels& of = kernels());

  /// The solids whose bounds, grown by `margin_m`, overlap the given ones and whose open height intervals overlap
  /// (z_low_m, z_high_m), in ascending order; `found` is overwritten.
  void near(const Bounds& bounds, double margin_m, double z_low_m, double z_high_m,
            std::vector<std::uint32_t>& found) const;

  /// True if an upright solid with this outline and height interval overlaps any of them (see separation()).
  bool collides(const Outline& outline, double z_low_m, double z_high_m) const;

 private:
  struct Solid {
    Outline outline;
    Bounds bounds;
    double z_low_m, z_high_m;
    bool shares_height(double z_low, double z_high) const { return z_low_m < z_high && z_low < z_high_m; }
  };

  template <class Visit>
  void visit(const Bounds& bounds, Visit visit) const;

  const Kernels* kernels_;
  std::vector<std::shared_ptr<const ConvexPolygon>> polygons_;  // of the outlines
  std::vector<Solid> solids_;
  Tree tree_;
};

}  // namespace waitpoint::world
