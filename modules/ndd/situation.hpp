// SPDX-License-Identifier: BSD-3-Clause
// The situation of the robot, and the direction of motion that follows from it.
//
//   an obstacle within the security distance?
//     none       the goal in the region  HSGR  the goal's direction
//                a wide region           HSWR  a security distance beside its edge
//                a narrow region         HSNR  its middle
//     one side   the goal in the region  LSGR  the direction of HSGR     } turned away from the obstacle,
//                else                    LS1   that of HSWR or HSNR      } more the nearer it is
//     two sides                          LS2   the high-safety direction, turned to the side with more room
//
// Minguez and Montano 2004; LSGR: Minguez, Osuna, Montano, ICRA 2004.
#pragma once

#include "modules/ndd/region_choice.hpp"

namespace waitpoint::ndd {

enum class Situation : std::uint8_t {
  no_region,                  ///< nowhere to go
  high_safety_goal_region,    ///< HSGR
  high_safety_wide_region,    ///< HSWR
  high_safety_narrow_region,  ///< HSNR
  low_safety_goal_region,     ///< LSGR
  low_safety_one_side,        ///< LS1
  low_safety_two_sides,       ///< LS2
};

/// The usual short name: "LS1".
const char* to_string(Situation situation);

struct Assessment {
  Situation situation = Situation::no_region;
  double direction_rad = 0;  ///< within +-pi/2 of ahead
  double safety = 1;         ///< hull distance of the nearest obstacle in security distances, at most 1
  double nearest_rad = 0;    ///< direction of that obstacle; undefined if `safety` is 1
};

/// The direction for a choice without obstacles within the security distance, in (-pi, pi].
Assessment high_safety(const Diagram& diagram, const Choice& choice, double robot_radius_m, double security_distance_m);

/// Turns the high-safety `free_way` away from the obstacles within the security distance. Obstacles behind the robot
/// are ignored: it drives backwards only to back out.
Assessment with_obstacles(const Diagram& diagram, const Assessment& free_way, double robot_radius_m,
                          double security_distance_m);

}  // namespace waitpoint::ndd
