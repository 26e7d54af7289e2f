// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/known_space.hpp"

#include <algorithm>

#include "modules/executive/distance_transform.hpp"

namespace waitpoint::executive {

const std::vector<std::uint16_t>& KnownSpace::clearances() const {
  if (!clearances_.empty()) return clearances_;
  const std::span<const Cell> cells = map_.cells();
  std::vector<std::uint8_t> occupied(cells.size());
  std::transform(cells.begin(), cells.end(), occupied.begin(), [](Cell cell) { return cell == Cell::occupied; });
  clearances_.resize(cells.size());
  DistanceTransform().run(occupied, map_.width(), map_.height(), clearances_);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i] == Cell::unknown) clearances_[i] = 0;
  return clearances_;
}

}  // namespace waitpoint::executive
