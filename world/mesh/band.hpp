// SPDX-License-Identifier: BSD-3-Clause
// The parts of all surfaces between two heights, seen from above: all that an upright body of these heights can meet.
//
// A body that does not climb always meets the same parts, so triangles are clipped once, not for each query; and the
// tree has only the parts at the body's height, each with its own bounds.
#pragma once

#include <cstdint>
#include <vector>

#include "world/mesh/surfaces.hpp"

namespace waitpoint::world {

class Band {
 public:
  /// Between two heights, as in Surfaces::separation(). Triangles have the numbers of the surfaces.
  Band(const Surfaces& surfaces, double z_low_m, double z_high_m);

  double z_low_m() const { return z_low_m_; }
  double z_high_m() const { return z_high_m_; }

  /// The triangles with a part whose bounds overlap these, and possibly a few that only nearly do, in ascending order;
  /// `found` is overwritten.
  void near(const Bounds& bounds, std::vector<std::uint32_t>& found) const;

  /// The distance of Surfaces::separation() for these heights, to the last bit.
  double separation_m(const Outline& body, std::uint32_t number) const;

  /// True if that distance is negative for any triangle.
  bool collides(const Outline& body) const;

 private:
  /// Calls `visit(part)` for the parts whose bounds overlap these, and possibly a few more, until it returns false.
  template <class Visit>
  void visit(const Bounds& bounds, Visit visit) const;

  double z_low_m_, z_high_m_;
  std::vector<Outline> parts_;            // in the order of the tree
  std::vector<std::uint32_t> triangles_;  // of each part
  std::vector<std::uint32_t> by_triangle_,
      first_of_;  // the parts in the order of triangles; the first of each triangle
  Tree tree_;
};

}  // namespace waitpoint::world
