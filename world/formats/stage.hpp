// SPDX-License-Identifier: BSD-3-Clause
// Worlds of the Stage simulator: obstacles and robots.
//
//   model      an obstacle: a bitmap's dark pixels, its blocks, or else a box of its size. A bitmap or the blocks fill
//              the size; `boundary 1` adds walls around it. Models in a model are on top of it.
//   position   a robot: a box of its size (0.1 m by default), as high as its highest part. Its parts are on top of it.
//   ranger     each sensor is a laser without noise; sensors with one sample each at one place, with evenly spaced
//              headings, are one laser with as many beams.
//
//   pose [x y z heading]    in the parent, degrees          origin [x y]    of the centre, from the pose
//   drive      "diff", "omni", or "car", which steers: wheelbase (1 m), at most 45 degrees
//   samples (1), fov (0 degrees), range [least most] (0 to 5 m), update_interval (100 ms)
//   velocity_bounds, acceleration_bounds: eight numbers, of which the second and the last count (1 m/s, 90 degrees/s);
//   for a car the last are the steering's (degrees, degrees/s)
//   obstacle_return, ranger_return: a model open to both bodies and beams is left out; a model open to only one of them
//   is an obstacle to both
//
// Everything else (windows, colours, controllers, ...) is left out with a warning. The syntax is in stage_syntax.hpp.
#pragma once

#include <string>
#include <vector>

#include "world/description.hpp"
#include "world/formats/left_out.hpp"
#include "world/formats/robot_origin.hpp"

namespace waitpoint::world {

struct StageWorld {
  std::vector<Obstacle> obstacles;
  std::vector<BodyDescription> bodies;  ///< in the order of the file; distinct names ("TYPE_0" by default)
  std::vector<RobotOrigin> origins;     ///< one per body
};

/// Reads the contents of a world file; `file` is its name, for messages and for includes. BadInput, naming file and
/// line, for malformed text, an undefined type, an invalid number or one out of range, an unreadable bitmap, and for
/// more than obstacle_count_max obstacles or a million things.
StageWorld parse_stage(const std::string& contents, const std::string& file, LeftOut& left_out);

}  // namespace waitpoint::world
