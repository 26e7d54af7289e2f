// SPDX-License-Identifier: BSD-3-Clause
// The speeds with which a base without sideways motion follows a trajectory: those of the trajectory, and a feedback of
// the error, in the robot's frame (x, y, angle) to the point where it ought to be (Kanayama et al., ICRA 1990; Samson,
// IEEE Trans. Robotics and Automation 9, 1993):
//
//   v = v_ref cos(angle) + k_x x                                  |k_x x| at most 0.3 m/s
//   w = w_ref + k_y v_ref y sin(angle) / angle + k_a angle        the correction at most 0.6 rad/s
//
// It converges while the trajectory moves; turns on the spot correct the heading alone.
#pragma once

#include "modules/executive/trajectory.hpp"
#include "modules/posters/navigation.hpp"

namespace waitpoint::executive {

/// The speeds of a robot at `pose` that ought to be at `wanted`.
posters::SpeedInput tracking_speeds(const TrajectoryPoint& wanted, const Pose& pose);

}  // namespace waitpoint::executive
