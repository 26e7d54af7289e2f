// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/line_geometry.hpp"

#include "core/exact_math.hpp"

namespace waitpoint::segloc {

void Line::turn_to(double angle) {
  angle_rad = exact::wrap_angle(angle);
  const auto [sine, cosine] = exact::sincos(angle_rad);
  normal = {cosine, sine};
}

LineObservation line_observation(const posters::Segment& segment) {
  LineObservation o;
  o.start = segment.start;
  o.end = segment.end;
  o.middle = 0.5 * (segment.start + segment.end);
  const Point along = segment.end - segment.start;
  o.length_m = length(along);
  const auto [sine, cosine] = exact::sincos(segment.normal_rad);
  const Point normal{cosine, sine};
  // The poster's normal points away from the robot's centre, which may be on the other side of the line than the
  // device.
  const bool same = dot(normal, {along.y, -along.x}) >= 0;
  const double side = same ? 1.0 : -1.0;
  o.angle_rad = same ? segment.normal_rad : exact::wrap_angle(segment.normal_rad + exact::pi);
  const auto [angle, mixed, distance] = segment.covariance;
  const double lever = cosine * o.middle.y - sine * o.middle.x;  // coordinate of the middle along the line
  o.covariance = {angle, side * (mixed - lever * angle), distance - 2.0 * lever * mixed + lever * lever * angle};
  return o;
}

double turning_lever(const Pose& robot, Point seen, Point normal) {
  const auto [sine, cosine] = exact::sincos(robot.heading);
  const Point turned{-(sine * seen.x + cosine * seen.y), cosine * seen.x - sine * seen.y};
  return dot(normal, turned);
}

Comparison compare(const Pose& robot, const LineObservation& observation, const Line& line) {
  const Point middle = transform(robot, observation.middle);
  Comparison c;
  c.angle_rad = exact::wrap_angle(observation.angle_rad - (line.angle_rad - robot.heading));
  c.offset_m = line.beyond(middle);
  c.by_pose[0] = {0, 0, -1};
  c.by_line[0] = {1, 0};
  c.by_pose[1] = {-line.normal.x, -line.normal.y, -turning_lever(robot, observation.middle, line.normal)};
  c.by_line[1] = {-line.place(middle), 1};
  return c;
}

Line line_from(const Pose& robot, const LineObservation& observation) {
  Line line;
  line.anchor = transform(robot, observation.middle);
  line.turn_to(observation.angle_rad + robot.heading);
  return line;
}

}  // namespace waitpoint::segloc
