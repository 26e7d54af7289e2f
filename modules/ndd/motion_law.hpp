// SPDX-License-Identifier: BSD-3-Clause
// Converts a direction to the speeds of a base that drives forwards and turns.
//
// The law: the turn rate is proportional to the direction; the speed falls with the direction's deviation from ahead
// and with the proximity of obstacles. The speed is then lowered until the robot could stop in its share of the free
// space:
//
//   every point q of the stopping path, and every obstacle point p, seen from the robot's centre:
//       q . p / |p|  <=  (|p| - radius - emergency distance) / 2
//
// This must hold on the path of the commanded turn, on that of the measured one and straight ahead: the next decision
// may turn otherwise, and a base responds with delay. It keeps the robot on its own side of the midpoint between its
// hull and p. So two robots that obey the rule never collide, however they move, and neither needs to recognise the
// other as a robot (the idea of buffered Voronoi cells: Zhou, Wang, Bandyopadhyay, Schwager, RA-L 2017). At creep
// speed, half the emergency distance from p suffices.
#pragma once

#include <span>
#include <vector>

#include "modules/ndd/parameters.hpp"

namespace waitpoint::ndd {

struct Speeds {
  double v_m_s = 0, w_rad_s = 0;
};

/// Speeds by the law: `direction_rad` within +-pi/2, `safety` in [0, 1], forward speed at most `v_m_s_max`.
Speeds motion_law(const Parameters& parameters, double direction_rad, double safety, double v_m_s_max);

/// The way of a stop from `v_m_s` >= 0.
double stopping_distance_m(const Parameters& parameters, double v_m_s);

/// The point after `part` of an arc of this length (negative: backwards) and turn, which starts at the origin, ahead.
Point along_arc(double length_m, double turn_rad, double part);

/// Speeds that the limiters try, of the wanted ones down to 0.
inline constexpr int speed_steps = 12, turn_steps = 4;

/// Lowers forward speeds until the stopping path is safe from obstacle points in the robot's frame.
class SpeedLimiter {
 public:
  explicit SpeedLimiter(const Parameters& parameters) : parameters_(parameters) {}

  /// Speeds with the greatest admissible v <= wanted.v_m_s. The turn rate is that of `wanted`, or less if the robot at
  /// its `measured` speeds could not stop on the turn.
  Speeds limit(const Speeds& wanted, const Speeds& measured, std::span<const Point> obstacles);

 private:
  bool can_stop(double v_m_s, double w_rad_s) const;
  bool can_creep(double v_m_s, double w_rad_s) const;

  Parameters parameters_;
  std::vector<Point> near_;         // obstacles within reach of any stopping path
  std::vector<double> distance_m_;  // from the robot's centre to each of these
};

}  // namespace waitpoint::ndd
