// SPDX-License-Identifier: BSD-3-Clause
// Keeps the map that the robot has seen up to date: enters the laser's newest scan at the fused position of its date.
#pragma once

#include "modules/executive/seen_map.hpp"
#include "modules/genom/name_space.hpp"
#include "modules/posters/odometry_trail.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::executive {

class Surveyor {
 public:
  /// `map` is borrowed.
  Surveyor(const OccupancyGrid& map, double range_m_max) : seen_(map, range_m_max) {}

  /// Connects pom.position, sick.echoes and rflex.odometry; a missing poster, or one of another type, is BadInput.
  void connect(const genom::NameSpace& names);

  /// Enters the newest scan, once. To be called at least at the laser's period: between two calls the motion is taken
  /// as straight.
  void look();

  const SeenMap& seen() const { return seen_; }
  void forget() { seen_.forget(); }

 private:
  SeenMap seen_;
  posters::OdometryTrail trail_;
  posters::Echoes scan_;
  std::uint32_t number_ = 0;  // of the last scan entered
  genom::PosterLink<posters::FusedPosition> position_{"pom.position"};
  genom::PosterLink<posters::Echoes> echoes_{"sick.echoes"};
  genom::PosterLink<posters::Odometry> odometry_{"rflex.odometry"};
};

}  // namespace waitpoint::executive
