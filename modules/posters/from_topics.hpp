// SPDX-License-Identifier: BSD-3-Clause
// Values that nodes of ROS publish for the modules of their robot.
#pragma once

#include <array>

#include "core/fields.hpp"

namespace waitpoint::posters {

/// A geometry_msgs/PoseWithCovarianceStamped in the map.
struct PoseOfTopic {
  double date_s = 0;  ///< of the pose, in virtual time
  Pose pose;
  std::array<double, 9> covariance{};  ///< as in PositionEstimate

  static void fields(auto field) {
    field("date_s", &PoseOfTopic::date_s);
    field("pose", &PoseOfTopic::pose);
    field("covariance", &PoseOfTopic::covariance);
  }
};

}  // namespace waitpoint::posters
