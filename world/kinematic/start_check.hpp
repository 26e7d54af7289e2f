// SPDX-License-Identifier: BSD-3-Clause
// Whether every body, and everything that is loose, starts in free space.
#pragma once

#include <string>
#include <vector>

#include "world/description.hpp"

namespace waitpoint::world {

/// A body that starts inside, or nearer than the contact gap to, something solid.
struct StartOverlap {
  std::string body;
  std::string other;  ///< name of the obstacle or of the other body
  bool other_is_body = false;
};

/// All such pairs, bodies in the order of the description, obstacles first; empty if the world can start.
std::vector<StartOverlap> start_overlaps(const WorldDescription& description);

/// Something loose that starts deeper inside another obstacle than this: less is taken for touching.
inline constexpr double loose_overlap_max_m = 1e-3;
struct LooseOverlap {
  std::string loose, other;  ///< names of obstacles
};
std::vector<LooseOverlap> loose_overlaps(const WorldDescription& description);
/// Whether two shapes are that deep inside each other.
bool overlap(const Shape& a, const Shape& b);

}  // namespace waitpoint::world
