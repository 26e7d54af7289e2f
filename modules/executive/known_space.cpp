// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/known_space.hpp"

#include <cstring>

#include "modules/executive/distance_transform.hpp"

namespace waitpoint::executive {

void KnownSpace::find_clearances() const {
  const std::span<const Cell> cells = map_.cells();
  clearances_.resize(cells.size());
  DistanceTransform().run(cells, map_.width(), map_.height(), clearances_);
  const auto find_unknown = [](const Cell* from, const Cell* end) {
    return static_cast<const Cell*>(
        std::memchr(from, static_cast<int>(Cell::unknown), static_cast<std::size_t>(end - from)));
  };
  const Cell* const begin = cells.data();
  const Cell* const end = begin + cells.size();
  for (const Cell* cell = find_unknown(begin, end); cell != nullptr; cell = find_unknown(cell, end))
    for (; cell < end && *cell == Cell::unknown; ++cell) clearances_[static_cast<std::size_t>(cell - begin)] = 0;
}

}  // namespace waitpoint::executive
