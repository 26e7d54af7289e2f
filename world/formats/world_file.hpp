// SPDX-License-Identifier: BSD-3-Clause
// Reads world files of all formats. The format is recognised by the file's first word, not by its name:
//
//   "<"                   SDF                     sdf.hpp
//   a number              a segment map           segments.hpp
//   "key:" or "---"       ROS's map_server YAML   map_server.hpp
//   "word"                Stage's world           stage.hpp
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "world/description.hpp"
#include "world/formats/robot_origin.hpp"

namespace waitpoint::world {

enum class WorldFormat { sdf, segments, map_server, stage };

/// The world of one file and of the files that it names.
struct WorldFile {
  std::vector<Obstacle> obstacles;  ///< including those of a map's cells
  std::vector<MeshObstacle> meshes;
  std::vector<BodyDescription> bodies;  ///< robots, in the order of the file
  std::vector<RobotOrigin> origins;     ///< one per body
  std::optional<OccupancyGrid> grid;    ///< of a map of cells
  bool has_heights = false;             ///< the format has heights
  std::vector<std::string> warnings;    ///< parts left out or approximated, a line each
};

/// The format of a file with these contents; none if it is unknown.
std::optional<WorldFormat> format_of(std::string_view contents);

/// Reads a file of any format. Obstacles of formats without heights extend from the floor to `height_m`. BadInput, one
/// line that names file, line and the expected input, for unreadable files.
WorldFile read_world_file(const std::string& file, double height_m);

}  // namespace waitpoint::world
