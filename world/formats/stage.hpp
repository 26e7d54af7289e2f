// SPDX-License-Identifier: BSD-3-Clause
// Worlds of the Stage simulator: what stands in them, and the robots.
//
//   model      what stands: a bitmap's dark pixels, its blocks, or else a box of its size. A bitmap or the blocks fill
//              the size; with `boundary 1` walls stand about it. Models in a model stand on it.
//   position   a robot: a box of its size (0.1 m where it gives none), as high as the highest that it carries. What it
//              carries stands on it.
//   ranger     each sensor is a laser without noise; sensors of one sample each at one place, their headings evenly
//              spaced, are one laser of as many beams.
//
//   pose [x y z heading]    in what holds it, degrees       origin [x y]    of the middle, from the pose
//   drive      "diff", "omni", or "car", which steers: wheelbase (1 m), at most 45 degrees
//   samples (1), fov (0 degrees), range [least most] (0 to 5 m), update_interval (100 ms)
//   velocity_bounds, acceleration_bounds: eight numbers, of which the second and the last count (1 m/s, 90 degrees/s);
//   of a car the last are the steering's (degrees, degrees/s)
//   obstacle_return, ranger_return: what bodies pass through and beams too is not there; what only one of them passes
//   is
//
// Everything else (windows, colours, controllers, ...) is left out and told. The text is stage_syntax.hpp's matter.
#pragma once

#include <string>
#include <vector>

#include "world/description.hpp"
#include "world/formats/left_out.hpp"
#include "world/formats/robot_origin.hpp"

namespace waitpoint::world {

struct StageWorld {
  std::vector<Obstacle> obstacles;
  std::vector<BodyDescription> bodies;  ///< in the order of the file; names differ ("TYPE_0" where none is given)
  std::vector<RobotOrigin> origins;     ///< of each of them
};

/// Reads the contents of a world file; `file` is its name, for messages and for what it includes. BadInput, naming file
/// and line, for what does not parse, a type that is not defined, a number that is none or out of range, a bitmap that
/// cannot be read, and for more than obstacle_count_max obstacles or a million things.
StageWorld parse_stage(const std::string& contents, const std::string& file, LeftOut& left_out);

}  // namespace waitpoint::world
