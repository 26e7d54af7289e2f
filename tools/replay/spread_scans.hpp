// SPDX-License-Identifier: BSD-3-Clause
// The scans of a trajectory that are apart from each other: those in between, such as of a robot at rest, add little to
// a map, and would outweigh the others.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "modules/playback/playback.hpp"

namespace waitpoint::tools {

/// Each at least `apart` in metres, or radians, from the one before it in the result.
inline std::vector<playback::StampedPose> spread_scans(std::span<const playback::StampedPose> trajectory,
                                                       double apart) {
  std::vector<playback::StampedPose> spread;
  for (const playback::StampedPose& at : trajectory) {
    const bool is_near = !spread.empty() && length(at.pose.position() - spread.back().pose.position()) < apart &&
                         std::fabs(exact::wrap_angle(at.pose.heading - spread.back().pose.heading)) < apart;
    if (!is_near) spread.push_back(at);
  }
  return spread;
}

}  // namespace waitpoint::tools
