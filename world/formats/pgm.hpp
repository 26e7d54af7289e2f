// SPDX-License-Identifier: BSD-3-Clause
// Netpbm grey maps: "P5" or "P2", width, height, greatest value (1 to 65535, scaled to 255), then the pixels; in P5 two
// bytes each, big-endian, if the greatest value exceeds 255. '#' starts a comment, in the header and anywhere in P2.
#pragma once

#include <string>
#include <string_view>

#include "world/formats/grey_image.hpp"

namespace waitpoint::world {

/// Reads the contents of a PGM file; `file` is its name, for messages. BadInput as in read_grey_image().
GreyImage parse_pgm(std::string_view contents, const std::string& file);

}  // namespace waitpoint::world
