// SPDX-License-Identifier: BSD-3-Clause
// The messages of ROS 1 and ROS 2 (CDR) and those of Foxglove in JSON that a log of sensors is made of.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/pose.hpp"
#include "core/time.hpp"

namespace waitpoint::logs {

enum class Encoding { ros1, cdr, json };

/// A frame in its parent, in space.
struct SpaceFrame {
  std::string parent;
  double x = 0, y = 0, z = 0;
  double qx = 0, qy = 0, qz = 0, qw = 1;
};

struct ScanMessage {
  Time stamp;
  std::string frame;
  double first_angle_rad = 0, angle_step_rad = 0;
  double range_min_m = 0, range_max_m = 0;  ///< range_max_m 0: unknown, or none
  std::vector<float> range_m;
};

struct OdometryMessage {
  Time stamp;
  std::string child;  ///< empty: unknown
  Pose pose;
};

struct FrameMessage {
  Time stamp;
  std::string child;
  SpaceFrame frame;
};

/// BadInput, naming the message's `place`, for one that is cut off, malformed or has numbers beyond limits.hpp. Ranges
/// beyond their limit, as those that are no numbers, are infinite: no echoes.
ScanMessage parse_scan(const std::string& place, Encoding encoding, std::string_view message);
OdometryMessage parse_odometry(const std::string& place, Encoding encoding, std::string_view message);
std::vector<FrameMessage> parse_frames(const std::string& place, Encoding encoding, std::string_view message);

/// The heading of a rotation: that of the x axis in the plane.
double heading_of(double qx, double qy, double qz, double qw);

}  // namespace waitpoint::logs
