// SPDX-License-Identifier: BSD-3-Clause
// A robot's sensors in a scenario. Keys are the field names of world/sensor_description.hpp, in degrees if the key says
// so; defaults are those of the fields or of the `model`.
#pragma once

#include <string>

#include "modules/scenario/yaml_reader.hpp"
#include "world/sensor_description.hpp"

namespace waitpoint::scenario {

struct LaserReading {
  world::LaserDescription laser;
  std::string name;  ///< default "laser"
};

LaserReading read_laser(const YamlNode& node);
world::SonarRingDescription read_sonar_ring(const YamlNode& node);
world::BumperDescription read_bumpers(const YamlNode& node);
world::InfraredRingDescription read_infrareds(const YamlNode& node);
world::ImuDescription read_imu(const YamlNode& node);
world::PositionReceiverDescription read_gps(const YamlNode& node);

}  // namespace waitpoint::scenario
