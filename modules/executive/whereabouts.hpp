// SPDX-License-Identifier: BSD-3-Clause
// True if the robot's localisation knows its place, and the places where a lost robot may look.
#pragma once

#include <optional>

#include "modules/genom/name_space.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::executive {

class Whereabouts {
 public:
  /// Connects locate.localisation, which may be missing, and sick.echoes and pom.position, which may not: BadInput.
  void connect(const genom::NameSpace& names);

  /// True if there is a module `locate`.
  bool has_localisation() const { return has_localisation_; }
  /// True if that module does not know the robot's position. `before`: the answer before its first scan.
  bool lost(bool before) const;
  /// A place ahead of the laser that a hull of `radius_m` can drive to, at most `distance_m_max` away: in the direction
  /// of the most space. Nothing if it has none.
  std::optional<Point> open_place(double radius_m, double distance_m_max) const;

 private:
  bool has_localisation_ = false;
  genom::PosterLink<posters::Localisation> localisation_{"locate.localisation"};
  genom::PosterLink<posters::FusedPosition> position_{"pom.position"};
  genom::PosterLink<posters::Echoes> echoes_{"sick.echoes"};
};

}  // namespace waitpoint::executive
