// SPDX-License-Identifier: BSD-3-Clause
// A robot's body in a scenario: `shape` or `urdf`, `base` with its odometry errors, and all sensors. Keys are the field
// names of world/description.hpp, in degrees if the key says so; defaults are those of the fields.
#pragma once

#include <string>
#include <vector>

#include "modules/scenario/keys.hpp"
#include "world/description.hpp"

namespace waitpoint::scenario {

/// The keys of a robot for its base and devices.
const KeyTable& device_keys();

struct BodyReading {
  world::BodyDescription body;           ///< without name and start
  std::vector<std::string> laser_names;  ///< in the order of body.sensors<world::Lasers>(); default "laser"
  std::vector<std::string> warnings;     ///< of its URDF
};

/// Reads these keys from a map that allows them. Where `shape` (or `urdf`), `lasers` or a key of `base` is omitted, the
/// value of `given`, if not null, applies.
BodyReading read_body(const YamlMap& robot, const BodyReading* given = nullptr);

}  // namespace waitpoint::scenario
