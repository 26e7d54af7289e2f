// SPDX-License-Identifier: BSD-3-Clause
// The files in which people already have worlds. Which kind a file is of, its first words tell, not its name:
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

/// What one file, with those that it names, says of a world.
struct WorldFile {
  std::vector<Obstacle> obstacles;  ///< those of a map's cells included
  std::vector<MeshObstacle> meshes;
  std::vector<BodyDescription> bodies;  ///< robots, in the order of the file
  std::vector<RobotOrigin> origins;     ///< of each of them
  std::optional<OccupancyGrid> grid;    ///< the cells, where the file is a map of cells
  bool has_heights = false;             ///< whether the file says how high things are
  std::vector<std::string> warnings;    ///< what is left out or taken otherwise, a line each
};

/// The kind of a file with these contents; none if they are none of them.
std::optional<WorldFormat> format_of(std::string_view contents);

/// Reads a file of any kind. What has no height of its own stands from the floor to `height_m`. BadInput, one line that
/// names file, line and what was expected, for whatever cannot be read.
WorldFile read_world_file(const std::string& file, double height_m);

}  // namespace waitpoint::world
