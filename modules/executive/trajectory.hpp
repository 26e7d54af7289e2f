// SPDX-License-Identifier: BSD-3-Clause
// A trajectory: poses with their times, such as localisation has found them in a log of a real robot.
//
// Its text is that of the TUM RGB-D benchmark: lines `stamp x y z qx qy qz qw`, and comments after '#'. Times are those
// since the first stamp. A pose at the stamp of the one before, or up to a second earlier, since it was written late,
// is left out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "core/time.hpp"

namespace waitpoint::executive {

/// A pose to be at, with the speeds of the trajectory there.
struct TrajectoryPoint {
  Pose pose;
  double v_m_s = 0, w_rad_s = 0;
};

class Trajectory {
 public:
  /// BadInput, at the line of `file`, unless it is a trajectory of at least two poses within a day.
  Trajectory(std::string_view text, const std::string& file);

  Duration duration() const { return poses_.back().time; }
  /// Interpolated; before the first pose or after the last, that one. The speeds are means over a second about `time`:
  /// stamps of logs jitter.
  TrajectoryPoint at(Duration time) const;

 private:
  struct TimedPose {
    Duration time;
    Pose pose;
  };

  Pose pose_at(Duration time) const;

  std::vector<TimedPose> poses_;  // their times increase
};

}  // namespace waitpoint::executive
