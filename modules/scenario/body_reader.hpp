// SPDX-License-Identifier: BSD-3-Clause
// A robot's body as a scenario writes it: `shape` or `urdf`, `base` with its odometry's errors, `battery`, `lasers`,
// `sonars`, `bumpers`, `infrareds`, `imu`, `gps`. The keys are the names of the fields in world/description.hpp, angles
// in degrees where the key says so; what is left out has the value given there.
#pragma once

#include <string>
#include <vector>

#include "modules/scenario/yaml_reader.hpp"
#include "world/description.hpp"

namespace waitpoint::scenario {

struct BodyReading {
  world::BodyDescription body;           ///< as read_body() reads it, without name and start
  std::vector<std::string> laser_names;  ///< in the order of body.lasers; "laser" where the scenario gives none
  std::vector<std::string> warnings;     ///< of its URDF
};

/// Reads these keys from a map that knows them. Where `shape` (or `urdf`), `lasers` or a key of `base` is left out, the
/// robot has that of `given`, if there is any.
BodyReading read_body(const YamlMap& robot, const BodyReading* given = nullptr);

}  // namespace waitpoint::scenario
