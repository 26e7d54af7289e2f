// SPDX-License-Identifier: BSD-3-Clause
// A robot's sensors as a scenario writes them. The keys are the names of the fields in world/sensor_description.hpp,
// angles in degrees where the key says so; what is left out has the value given there, or that of the `model`.
#pragma once

#include <string>

#include "modules/scenario/yaml_reader.hpp"
#include "world/sensor_description.hpp"

namespace waitpoint::scenario {

struct LaserReading {
  world::LaserDescription laser;
  std::string name;  ///< "laser" where the scenario gives none
};

LaserReading read_laser(const YamlNode& node);
world::SonarRingDescription read_sonar_ring(const YamlNode& node);
world::BumperDescription read_bumpers(const YamlNode& node);
world::InfraredRingDescription read_infrareds(const YamlNode& node);
world::ImuDescription read_imu(const YamlNode& node);
world::PositionReceiverDescription read_gps(const YamlNode& node);

}  // namespace waitpoint::scenario
