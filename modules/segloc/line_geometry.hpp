// SPDX-License-Identifier: BSD-3-Clause
// Lines in the map and as a robot sees them, with the derivatives that the filter needs.
//
// A line of the map is kept relative to an anchor, a fixed point near it:
//
//   normal(angle) . (p - anchor) = offset          normal(a) = (cos a, sin a), along(a) = (-sin a, cos a)
//
// so that an error of its angle does not become an error of metres at the map's origin, and no offset is special (the
// polar form is singular at distance 0; Castellanos and Tardos' SPmap uses local frames for the same reason). The
// normal points away from the side it is seen from: the two faces of a thin wall are two lines.
#pragma once

#include <array>

#include "core/pose.hpp"
#include "modules/posters/laser.hpp"

namespace waitpoint::segloc {

struct Line {
  Point anchor;
  double angle_rad = 0, offset_m = 0;
  Point normal{1, 0};  ///< that of angle_rad

  /// Sets the angle and the normal with it.
  void turn_to(double angle);
  Point along() const { return {-normal.y, normal.x}; }
  /// Signed distance of a point beyond the line, as seen from the side where it was observed.
  double beyond(Point p) const { return dot(normal, p - anchor) - offset_m; }
  /// Place of a point's foot along the line.
  double place(Point p) const { return dot(along(), p - anchor); }
  /// The point of the line at a place.
  Point at(double place_m) const { return anchor + offset_m * normal + place_m * along(); }
};

/// A segment as an observation of a line, in the robot's frame. Its error is that of the angle and of the offset at
/// the middle of what was seen, where the two are nearly uncorrelated.
struct LineObservation {
  double angle_rad = 0;  ///< of the normal that points away from the device
  Point start, middle, end;
  double length_m = 0;
  std::array<double, 3> covariance{};  ///< rad^2, rad m, m^2: (angle, angle), (angle, offset), (offset, offset)
};

LineObservation line_observation(const posters::Segment& segment);

/// Observed minus predicted (angle, offset), and the derivatives of the prediction by pose (x, y, heading) and by line
/// (angle, offset). `rows[0]` is the angle's.
struct Comparison {
  double angle_rad = 0, offset_m = 0;
  std::array<std::array<double, 3>, 2> by_pose{};
  std::array<std::array<double, 2>, 2> by_line{};
};

Comparison compare(const Pose& robot, const LineObservation& observation, const Line& line);

/// The line seen by a robot at `robot`, anchored at the middle of the observation.
Line line_from(const Pose& robot, const LineObservation& observation);

/// Derivative by the robot's heading of the offset that a point seen at `seen` (robot's frame) has along `normal`.
double turning_lever(const Pose& robot, Point seen, Point normal);

}  // namespace waitpoint::segloc
