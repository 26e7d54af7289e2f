// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/known_space.hpp"

#include "modules/executive/distance_transform.hpp"

namespace waitpoint::executive {

const std::vector<std::uint16_t>& KnownSpace::clearances() const {
  if (!clearances_.empty()) return clearances_;
  const std::size_t width = static_cast<std::size_t>(map_.width()), height = static_cast<std::size_t>(map_.height());
  std::vector<std::uint8_t> occupied(width * height);
  std::vector<std::size_t> unknown;
  for (CellIndex c; c.y < map_.height(); ++c.y) {
    for (c.x = 0; c.x < map_.width(); ++c.x) {
      const std::size_t at = static_cast<std::size_t>(c.y) * width + static_cast<std::size_t>(c.x);
      occupied[at] = map_[c] == Cell::occupied;
      if (map_[c] == Cell::unknown) unknown.push_back(at);
    }
  }
  clearances_.resize(occupied.size());
  DistanceTransform().run(occupied, map_.width(), map_.height(), clearances_);
  for (const std::size_t at : unknown) clearances_[at] = 0;
  return clearances_;
}

}  // namespace waitpoint::executive
