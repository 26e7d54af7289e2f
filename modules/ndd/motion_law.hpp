// SPDX-License-Identifier: BSD-3-Clause
// From a direction to the speeds of a base that drives forwards and turns.
//
// The law: turn in proportion to the direction, drive the slower the farther it is from ahead and the nearer the
// obstacles are. The speed is then lowered until the robot could stop in its share of the free space:
//
//   every point q of the stopping path, and every obstacle point p, seen from the robot's centre:
//       q . p / |p|  <=  (|p| - radius - emergency distance) / 2
//
// It must be so on the path of the commanded turn, on that of the measured one and straight on: the next decision may
// turn otherwise, and a base takes its time to do so. That is, the robot stays on its own side of the middle between
// its hull and p. So two robots that keep the rule never meet, however they move, and neither need know that the other
// one is a robot (the idea of buffered Voronoi cells: Zhou, Wang, Bandyopadhyay, Schwager, RA-L 2017). At a creep,
// staying half the emergency distance off p is enough.
#pragma once

#include <span>
#include <vector>

#include "modules/ndd/parameters.hpp"

namespace waitpoint::ndd {

struct Speeds {
  double v_m_s = 0, w_rad_s = 0;
};

/// What the law asks for: `direction_rad` within +-pi/2, `safety` in [0, 1], at most `v_m_s_max` ahead.
Speeds motion_law(const Parameters& parameters, double direction_rad, double safety, double v_m_s_max);

/// Lowers forward speeds until the stopping path is safe from obstacle points in the robot's frame.
class SpeedLimiter {
 public:
  explicit SpeedLimiter(const Parameters& parameters) : parameters_(parameters) {}

  /// Speeds with the greatest admissible v <= wanted.v_m_s. The turning speed is as wanted, unless the robot at its
  /// `measured` speeds could not stop on the turn: then it turns less.
  Speeds limit(const Speeds& wanted, const Speeds& measured, std::span<const Point> obstacles);

 private:
  bool can_stop(double v_m_s, double w_rad_s) const;
  bool can_creep(double v_m_s, double w_rad_s) const;

  Parameters parameters_;
  std::vector<Point> near_;         // obstacles that any stopping path could concern
  std::vector<double> distance_m_;  // of each from the robot's centre
};

}  // namespace waitpoint::ndd
