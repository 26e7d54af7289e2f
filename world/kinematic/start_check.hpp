// SPDX-License-Identifier: BSD-3-Clause
// Checks that every body and every loose obstacle starts in free space.
#pragma once

#include <string>
#include <vector>

#include "world/description.hpp"

namespace waitpoint::world {

/// A body that starts inside a solid, or nearer to it than the contact gap.
struct StartOverlap {
  std::string body;
  std::string other;  ///< name of the obstacle or of the other body
  bool other_is_body = false;
};

/// All overlaps, bodies in the order of the description, obstacles before bodies; empty if the start is valid.
std::vector<StartOverlap> start_overlaps(const WorldDescription& description);

/// A loose obstacle that starts deeper than this inside another obstacle; a smaller overlap counts as touching.
inline constexpr double loose_overlap_max_m = 1e-3;
struct LooseOverlap {
  std::string loose, other;  ///< names of obstacles
};
std::vector<LooseOverlap> loose_overlaps(const WorldDescription& description);
/// True if two shapes overlap by more than loose_overlap_max_m, in height and in the plane.
bool overlap(const Shape& a, const Shape& b);

}  // namespace waitpoint::world
