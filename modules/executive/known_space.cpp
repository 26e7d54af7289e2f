// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/known_space.hpp"

#include <algorithm>

#include "modules/executive/distance_transform.hpp"

namespace waitpoint::executive {

const std::vector<std::uint16_t>& KnownSpace::clearances() const {
  if (!clearances_.empty()) return clearances_;
  const std::span<const Cell> cells = map_.cells();
  clearances_.resize(cells.size());
  DistanceTransform().run(cells, map_.width(), map_.height(), clearances_);
  if (std::find(cells.begin(), cells.end(), Cell::unknown) == cells.end()) return clearances_;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i] == Cell::unknown) clearances_[i] = 0;
  return clearances_;
}

}  // namespace waitpoint::executive
