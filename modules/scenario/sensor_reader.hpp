// SPDX-License-Identifier: BSD-3-Clause
// A robot's sensors in a scenario, by their declarations (world/sensors/types): keys are the declared fields, defaults
// those of a description, or of the `model` of a laser.
#pragma once

#include <string>

#include "modules/scenario/keys.hpp"
#include "world/description.hpp"

namespace waitpoint::scenario {

/// The keys of a sensor of type S; of lasers and sonars with those that are not fields.
template <class S>
const Keys<typename S::Description>& sensor_keys() {
  static const Keys<typename S::Description> keys = Keys<typename S::Description>(std::string(S::key)).add_fields();
  return keys;
}
template <>
const Keys<world::LaserDescription>& sensor_keys<world::Lasers>();
template <>
const Keys<world::SonarRingDescription>& sensor_keys<world::Sonars>();

template <class S>
typename S::Description read_sensor(const YamlNode& node) {
  typename S::Description description;
  read_object(node, std::string(S::noun), sensor_keys<S>(), description);
  if constexpr (requires { S::contradiction(description); })
    if (const auto contradiction = S::contradiction(description)) throw node.written.bad(*contradiction);
  return description;
}

struct LaserReading {
  world::LaserDescription laser;
  std::string name;  ///< default "laser"
};

LaserReading read_laser(const YamlNode& node);

}  // namespace waitpoint::scenario
