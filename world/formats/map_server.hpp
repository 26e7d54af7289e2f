// SPDX-License-Identifier: BSD-3-Clause
// Maps of ROS's map_server: a YAML file that names an image and defines the meaning of its grey values.
//
//   image            PGM or PNG, relative to the YAML file; if it is
//                    not there, the file of its name beside it         (required)
//   resolution       metres a pixel                                    (required)
//   origin           [x, y, yaw] of the image's lower left corner      (required)
//   negate           0: dark is occupied (default), 1: light is
//   occupied_thresh  occupied above this probability (default 0.65)
//   free_thresh      free below this one (default 0.196)
//   mode             trinary (default), scale or raw
//
// The probability of a pixel v is (255 - v) / 255, or v / 255 with negate. `scale` differs from `trinary` in that
// transparent pixels are unknown (its shades between the thresholds are neither free nor occupied, so unknown here). In
// `raw`, v itself is the probability in percent, and above 100 unknown. The image's first row is the map's top.
#pragma once

#include <string>

#include "core/occupancy_grid.hpp"
#include "world/formats/left_out.hpp"

namespace waitpoint::world {

/// Reads the contents of such a file; `yaml_file` is its name, for messages and the path of the image. Other keys are
/// left out. BadInput, naming the file and line, for a malformed file, a duplicate or missing key, a value out of
/// range; and naming the image for an unusable image.
OccupancyGrid parse_map_server_map(const std::string& contents, const std::string& yaml_file, LeftOut& left_out);
/// Reads the file of that name, without its warnings.
OccupancyGrid read_map_server_map(const std::string& yaml_file);

}  // namespace waitpoint::world
