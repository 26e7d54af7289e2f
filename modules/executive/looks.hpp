// SPDX-License-Identifier: BSD-3-Clause
// Obstacles seen near the robot in the last seconds: laser echoes in the map frame, to be marked on the map when the
// way is reported as blocked. The robot may then face away from the obstacle.
#pragma once

#include <deque>
#include <vector>

#include "modules/genom/name_space.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::executive {

/// Connects a poster that the executive reads; a missing one, or one of another type, is BadInput.
void connect_for_executive(const genom::NameSpace& names, genom::PosterLinkBase& link);

class Looks {
 public:
  /// Echoes beyond `range_m_max` are left out.
  explicit Looks(double range_m_max) : range_m_max_(range_m_max) {}

  /// Connects pom.position and sick.echoes; a missing poster, or one of another type, is BadInput.
  void connect(const genom::NameSpace& names);
  /// True once both posters have values.
  bool have_begun() const;
  /// By pom.position.
  Point position() const;

  /// Keeps the current echoes; the oldest look is forgotten.
  void look();
  void clear() { looks_.clear(); }
  /// The points of all looks.
  std::vector<Point> seen() const;

 private:
  double range_m_max_;
  std::deque<std::vector<Point>> looks_;
  genom::PosterLink<posters::FusedPosition> position_{"pom.position"};
  genom::PosterLink<posters::Echoes> echoes_{"sick.echoes"};
};

}  // namespace waitpoint::executive
