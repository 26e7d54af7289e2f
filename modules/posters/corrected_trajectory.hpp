// SPDX-License-Identifier: BSD-3-Clause
// The past as a module sees it at the end of a run: a loop that closes late corrects where the robot was before. A
// poster has a fixed size, so this is an interface of the module, to be asked after the run.
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "core/time.hpp"

namespace waitpoint::posters {

struct StampedPose {
  Time date;
  Pose pose;
};

class CorrectedTrajectory {
 public:
  virtual ~CorrectedTrajectory() = default;

  /// The pose of the robot's centre at the date of each scan used, oldest first, in the frame of the first one; empty
  /// if the module recorded none.
  virtual std::vector<StampedPose> corrected() const = 0;
};

}  // namespace waitpoint::posters
