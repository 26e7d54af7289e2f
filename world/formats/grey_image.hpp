// SPDX-License-Identifier: BSD-3-Clause
// Grey images of 8 bits, as maps are drawn in: PGM (plain P2 and raw P5) and PNG, of all depths (scaled to 8 bits),
// with and without palette, transparency, interlacing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace waitpoint::world {

/// Rows from the top, each from the left.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> grey;          ///< width * height; the mean of a colour's channels
  std::vector<std::uint8_t> transparency;  ///< 255 where a pixel is fully transparent; empty where all are opaque
};

/// Reads an image, whose kind is told by its first bytes. BadInput, naming the file, if it is missing, of another kind,
/// cut short, or larger than OccupancyGrid::cells_max pixels.
GreyImage read_grey_image(const std::string& file);
/// Reads the contents of an image; `file` is its name, for messages.
GreyImage parse_grey_image(const std::string& contents, const std::string& file);

}  // namespace waitpoint::world
