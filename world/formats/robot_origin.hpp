// SPDX-License-Identifier: BSD-3-Clause
// Where a robot of a world's file comes from, and what its things are called there.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::world {

struct RobotOrigin {
  std::string file;
  int line = 0;
  std::vector<std::string> types;        ///< its own first, then what that one is made from, to the built-in one
  std::vector<std::string> laser_names;  ///< in the order of the body's lasers; they differ
};

}  // namespace waitpoint::world
