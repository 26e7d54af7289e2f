// SPDX-License-Identifier: BSD-3-Clause
// SpeedLimiter's rule for a robot that is no disc: the hull in its own shape, on every pose of the stopping path.
//
//   d0  distance of an obstacle point from the hull now, d at a pose of the path:
//       d >= (d0 + emergency distance) / 2, and no less than d0 once that is below the emergency distance
//
// At creep speed, in turning on the spot and in backing out, d >= emergency distance / 2 suffices, or d0 if that is
// less. Turning on the spot sweeps the corners, so it has a stopping path, too: if it is not free, the robot turns
// less, and if it can neither drive nor turn, it backs out slowly until it can.
#pragma once

#include <span>
#include <vector>

#include "core/footprint.hpp"
#include "modules/ndd/motion_law.hpp"

namespace waitpoint::ndd {

class ShapeLimiter {
 public:
  ShapeLimiter(const Parameters& parameters, const Footprint& footprint)
      : parameters_(parameters), footprint_(footprint) {}

  /// Admissible speeds near the wanted ones: the greatest v <= wanted.v_m_s at the wanted turn rate, or at the greatest
  /// part of it for which there is any; backwards if there is none.
  Speeds limit(const Speeds& wanted, const Speeds& measured, std::span<const Point> obstacles);

 private:
  struct Near {
    Point point;
    double least_m, least_slow_m;  // distances from the hull to be kept on the path
  };
  void take_near(double fastest_m_s, std::span<const Point> obstacles);
  /// Along an arc of this length (negative: backwards) and turn.
  bool is_free(double length_m, double turn_rad, double Near::*least) const;
  bool can_stop(double v_m_s, double w_rad_s, double Near::*least) const;
  bool can_turn(double w_rad_s) const;

  Parameters parameters_;
  Footprint footprint_;
  std::vector<Near> near_;
};

}  // namespace waitpoint::ndd
