// SPDX-License-Identifier: BSD-3-Clause
// Early avoidance: the direction nearest to the desired one in which a disc clears all obstacles ahead.
//
// The nearness diagram reacts within its security distance, which is late at 0.9 m/s against a robot approaching at the
// same speed. So the direction is first cleared of obstacles ahead: a point p at distance d forbids the directions
// within asin((radius + clearance) / d) of its own. If this leaves none, or only a large detour, the clearance is
// halved, at most twice.
#pragma once

#include "modules/ndd/diagram.hpp"
#include "modules/ndd/parameters.hpp"

namespace waitpoint::ndd {

class Bypass {
 public:
  explicit Bypass(const Parameters& parameters) : parameters_(parameters) {}

  /// The cleared direction; `wanted_rad` itself if no obstacle nearer than `distance_m` forbids it, or if all
  /// directions are forbidden. Of two similar ones, the side taken last is preferred, then the right-hand side.
  double clear(const Diagram& diagram, double wanted_rad, double distance_m);

 private:
  struct Forbidden {
    double angle_rad, half_width_rad;
  };
  void forbid(const Diagram& diagram, double distance_m, double clearance_m);
  /// The edge of the forbidden directions around `angle_rad` to the left (side 1) or right (-1), as an angle from it.
  double turn_out(double angle_rad, int side) const;

  Parameters parameters_;
  std::array<Forbidden, sector_count> forbidden_{};
  std::size_t count_ = 0;
  int side_ = -1;
};

}  // namespace waitpoint::ndd
