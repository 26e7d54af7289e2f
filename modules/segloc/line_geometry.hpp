// SPDX-License-Identifier: BSD-3-Clause
// Lines in the map and in the robot's frame, with the derivatives for the filter.
//
// A line of the map is stored relative to an anchor, a fixed point near it:
//
//   normal(angle) . (p - anchor) = offset          normal(a) = (cos a, sin a), along(a) = (-sin a, cos a)
//
// so that an error of its angle does not become an error of metres at the map's origin, and no offset is singular (the
// polar form is singular at distance 0; Castellanos and Tardos' SPmap uses local frames for the same reason). The
// normal points away from the observed side: the two faces of a thin wall are two lines.
#pragma once

#include <array>

#include "core/pose.hpp"
#include "modules/posters/laser.hpp"

namespace waitpoint::segloc {

struct Line {
  Point anchor;
  double angle_rad = 0, offset_m = 0;
  Point normal{1, 0};  ///< (cos angle_rad, sin angle_rad)

  /// Sets angle and normal.
  void turn_to(double angle);
  Point along() const { return {-normal.y, normal.x}; }
  /// Signed distance of a point beyond the line, as seen from the observed side.
  double beyond(Point p) const { return dot(normal, p - anchor) - offset_m; }
  /// Coordinate along the line of a point's projection.
  double place(Point p) const { return dot(along(), p - anchor); }
  /// The point of the line with this coordinate.
  Point at(double place_m) const { return anchor + offset_m * normal + place_m * along(); }
};

/// A segment as an observation of a line, in the robot's frame. Its error is in the angle and in the offset at the
/// middle of the segment, where the two are nearly uncorrelated.
struct LineObservation {
  double angle_rad = 0;  ///< of the normal, which points away from the device
  Point start, middle, end;
  double length_m = 0;
  std::array<double, 3> covariance{};  ///< rad^2, rad m, m^2: (angle, angle), (angle, offset), (offset, offset)
};

LineObservation line_observation(const posters::Segment& segment);

/// Observed minus predicted (angle, offset), and the derivatives of the prediction by pose (x, y, heading) and by line
/// (angle, offset). `rows[0]` is that of the angle.
struct Comparison {
  double angle_rad = 0, offset_m = 0;
  std::array<std::array<double, 3>, 2> by_pose{};
  std::array<std::array<double, 2>, 2> by_line{};
};

Comparison compare(const Pose& robot, const LineObservation& observation, const Line& line);

/// The line observed from `robot`, anchored at the middle of the observation.
Line line_from(const Pose& robot, const LineObservation& observation);

/// Derivative, by the robot's heading, of the coordinate along `normal` of a point at `seen` (robot's frame).
double turning_lever(const Pose& robot, Point seen, Point normal);

}  // namespace waitpoint::segloc
