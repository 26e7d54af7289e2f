// SPDX-License-Identifier: BSD-3-Clause
// A grey image of 8 bits, as maps are drawn in.
#pragma once

#include <cstdint>
#include <vector>

namespace waitpoint::world {

/// Rows from the top, each from the left.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> grey;          ///< width * height; the mean of a colour's channels
  std::vector<std::uint8_t> transparency;  ///< 255 where a pixel is fully transparent; empty where all are opaque
};

}  // namespace waitpoint::world
