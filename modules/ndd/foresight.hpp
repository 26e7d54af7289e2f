// SPDX-License-Identifier: BSD-3-Clause
// Speeds that avoid obstacles in motion, by where they will be.
//
// Each of some pairs of speeds is followed for some seconds: the base takes them up at its acceleration, turns for a
// moment, then drives straight on; tracked obstacles keep their velocities, all others stand, and before these the
// robot stops in time. The wanted speeds are kept unless they lead to a contact, or near one. Else those are taken
// that lead to the latest contact, keep the greatest distance and are nearest to the wanted ones; they may be faster,
// or backwards.
#pragma once

#include <span>
#include <vector>

#include "core/footprint.hpp"
#include "modules/ndd/diagram.hpp"
#include "modules/ndd/motion_law.hpp"

namespace waitpoint::ndd {

class Foresight {
 public:
  struct Disc {
    Point centre, velocity;
    double radius_m = 0;
  };

  Foresight(const Parameters& parameters, const Footprint& footprint)
      : parameters_(parameters), footprint_(footprint) {}

  /// `moving`: obstacles in motion, and `points`: all known obstacle points, both in the robot's frame.
  Speeds choose(const Speeds& wanted, const Speeds& measured, std::span<const Disc> moving,
                std::span<const Point> points);

 private:
  struct Outlook {
    double contact_s;  // when it touches an obstacle; the horizon or later: not foreseen
    double closeness;  // 0: always far from obstacles in motion; 1: touches one at once
  };
  void take_standing(std::span<const Disc> moving, std::span<const Point> points);
  Outlook follow(const Speeds& commanded, const Speeds& measured, std::span<const Disc> moving) const;
  double cost(const Speeds& speeds, const Speeds& wanted, const Speeds& measured, std::span<const Disc> moving) const;

  Parameters parameters_;
  Footprint footprint_;
  std::vector<Point> standing_;
  Speeds last_;
};

}  // namespace waitpoint::ndd
