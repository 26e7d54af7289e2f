// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/message_values.hpp"

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "modules/logs/limits.hpp"

namespace waitpoint::logs {
namespace {

constexpr std::size_t beams_max = 100'000;
constexpr float no_echo_m = std::numeric_limits<float>::infinity();
constexpr double rotation_max = 1e6;  // of its parts, which need not have the length 1

double within(const std::string& place, const char* what, double magnitude_max, double value) {
  if (!(std::fabs(value) <= magnitude_max))
    throw BadInput(place, "expected " + limited_text(what, magnitude_max) + ", found " + number_text(value));
  return value;
}
double beam_angle(const std::string& place, double value) {
  return within(place, "a beam's angle", beam_angle_max_rad, value);
}

template <class Range>
void take_ranges(const std::string& place, const std::vector<Range>& ranges, double range_min_m, LoggedScan& scan) {
  if (ranges.size() > beams_max)
    throw BadInput(place, "expected at most " + std::to_string(beams_max) + " elements in a message");
  scan.range_m.reserve(ranges.size());
  for (const Range range_m : ranges)
    scan.range_m.push_back(std::fabs(range_m) <= range_max_m && static_cast<float>(range_m) >= range_min_m
                               ? static_cast<float>(range_m)
                               : no_echo_m);
}

void check_span(const std::string& place, const LoggedScan& scan) {
  const std::string error = span_error(scan.range_m.size(), scan.angle_step_rad);
  if (!error.empty()) throw BadInput(place, error);
}

template <class Point>
void check(const std::string& place, const Point& at, const messages::geometry_msgs::Quaternion& turn) {
  for (const double value : {at.x, at.y, at.z}) within(place, "a coordinate", position_max_m, value);
  for (const double value : {turn.x, turn.y, turn.z, turn.w})
    within(place, "a part of a rotation", rotation_max, value);
}

}  // namespace

LoggedScan scan_of(const std::string& place, const messages::sensor_msgs::LaserScan& message) {
  LoggedScan scan{.stamp = messages::time_of(message.header.stamp)};
  scan.first_angle_rad = beam_angle(place, message.angle_min);
  scan.angle_step_rad = beam_angle(place, message.angle_increment);
  const double range_min_m = within(place, "the least range", range_max_m, message.range_min);
  if (message.range_max > 0 && message.range_max <= range_max_m) scan.range_max_m = message.range_max;
  take_ranges(place, message.ranges, range_min_m, scan);
  check_span(place, scan);
  return scan;
}

LoggedScan scan_of(const std::string& place, const messages::foxglove::LaserScan& message) {
  LoggedScan scan{.stamp = messages::time_of(message.timestamp)};
  scan.first_angle_rad = beam_angle(place, message.start_angle);
  const double last_rad = beam_angle(place, message.end_angle);
  take_ranges(place, message.ranges, 0, scan);
  if (scan.range_m.size() > 1)
    scan.angle_step_rad = (last_rad - scan.first_angle_rad) / static_cast<double>(scan.range_m.size() - 1);
  check_span(place, scan);
  return scan;
}

const messages::geometry_msgs::Pose& checked(const std::string& place, const messages::geometry_msgs::Pose& pose) {
  check(place, pose.position, pose.orientation);
  return pose;
}
const messages::geometry_msgs::Transform& checked(const std::string& place,
                                                  const messages::geometry_msgs::Transform& transform) {
  check(place, transform.translation, transform.rotation);
  return transform;
}

}  // namespace waitpoint::logs
