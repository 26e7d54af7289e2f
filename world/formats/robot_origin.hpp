// SPDX-License-Identifier: BSD-3-Clause
// The source of a robot in a world file, and the names in it.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::world {

struct RobotOrigin {
  std::string file;
  int line = 0;
  std::vector<std::string> types;        ///< its own type first, then the base types, down to the built-in one
  std::vector<std::string> laser_names;  ///< in the order of the body's lasers; distinct
};

}  // namespace waitpoint::world
