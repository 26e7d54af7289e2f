// SPDX-License-Identifier: BSD-3-Clause
// Reads image files as greyscale images: PGM (plain P2 and raw P5) and PNG, of all depths (scaled to 8 bits), with and
// without palette, transparency, interlacing.
#pragma once

#include <string>

#include "world/formats/grey_image.hpp"

namespace waitpoint::world {

/// Reads an image; its format is recognised by the first bytes. BadInput, naming the file, if it is missing, of another
/// format, truncated, or larger than OccupancyGrid::cells_max pixels.
GreyImage read_grey_image(const std::string& file);
/// Reads the contents of an image; `file` is its name, for messages.
GreyImage parse_grey_image(const std::string& contents, const std::string& file);

}  // namespace waitpoint::world
