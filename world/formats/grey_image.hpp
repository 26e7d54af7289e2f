// SPDX-License-Identifier: BSD-3-Clause
// An 8-bit greyscale image, the format of maps.
#pragma once

#include <cstdint>
#include <vector>

namespace waitpoint::world {

/// Rows from top to bottom, each from left to right.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> grey;          ///< width * height; the mean of a colour's channels
  std::vector<std::uint8_t> transparency;  ///< 255: fully transparent; empty if all pixels are opaque
};

}  // namespace waitpoint::world
