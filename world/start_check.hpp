// SPDX-License-Identifier: BSD-3-Clause
// Whether every body starts in free space.
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

}  // namespace waitpoint::world
