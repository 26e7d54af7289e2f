// SPDX-License-Identifier: BSD-3-Clause
// Passing obstacles by from afar: the nearest direction to the wanted one in which a disc clears them all.
//
// The nearness diagram reacts within its security distance; at 0.9 m/s against a robot that comes at the same speed
// that is late. So the direction is first cleared of the obstacles ahead: point p at distance d forbids the directions
// within asin((radius + clearance) / d) of its own. Where that leaves none, or only a long way round, the clearance is
// halved, at most twice.
#pragma once

#include "modules/ndd/diagram.hpp"
#include "modules/ndd/parameters.hpp"

namespace waitpoint::ndd {

class Bypass {
 public:
  explicit Bypass(const Parameters& parameters) : parameters_(parameters) {}

  /// The cleared direction; `wanted_rad` itself if it is clear of what lies nearer than `distance_m`, or if all are
  /// forbidden. Of two that are about as good, the side taken last is kept, else the right-hand one is taken.
  double clear(const Diagram& diagram, double wanted_rad, double distance_m);

 private:
  struct Forbidden {
    double angle_rad, half_width_rad;
  };
  void forbid(const Diagram& diagram, double distance_m, double clearance_m);
  /// The end of the forbidden directions about `angle_rad` to the left (side 1) or right (-1), as a turn from it.
  double turn_out(double angle_rad, int side) const;

  Parameters parameters_;
  std::array<Forbidden, sector_count> forbidden_{};
  std::size_t count_ = 0;
  int side_ = -1;
};

}  // namespace waitpoint::ndd
