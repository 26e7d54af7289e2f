// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/topic_log.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/printable_line.hpp"

namespace waitpoint::logs {
namespace {

bool is_scan(const std::string& type) {
  return type == "sensor_msgs/LaserScan" || type == "sensor_msgs/msg/LaserScan" || type == "foxglove.LaserScan";
}

bool is_odometry(const std::string& topic, const std::string& type) {
  if (type == "foxglove.PoseInFrame") return topic.ends_with("odometry");
  return type == "nav_msgs/Odometry" || type == "nav_msgs/msg/Odometry";
}

bool is_frames(const std::string& type) {
  return type == "tf2_msgs/TFMessage" || type == "tf/tfMessage" || type == "tf2_msgs/msg/TFMessage" ||
         type == "foxglove.FrameTransform";
}

// ROS 1 knew names of frames with and without a slash.
std::string without_slash(const std::string& frame) { return frame.starts_with('/') ? frame.substr(1) : frame; }

Eigen::Isometry3d transform_of(const SpaceFrame& frame) {
  const double length =
      std::sqrt(exact::square(frame.qw) + exact::square(frame.qx) + exact::square(frame.qy) + exact::square(frame.qz));
  const Eigen::Quaterniond turn =
      length > 0 ? Eigen::Quaterniond(frame.qw / length, frame.qx / length, frame.qy / length, frame.qz / length)
                 : Eigen::Quaterniond::Identity();
  return Eigen::Translation3d(frame.x, frame.y, frame.z) * turn;
}

/// The topic that was chosen among those of a map, or else the only one.
template <class Values>
typename Values::iterator chosen(Values& topics, const std::string& choice, const std::string& place) {
  std::vector<std::string_view> names;
  std::string list;
  for (const auto& [topic, values] : topics) {
    names.push_back(topic);
    list += (list.empty() ? "'" : ", '") + printable_line(topic) + "'";
  }
  if (choice.empty() && topics.size() == 1) return topics.begin();
  if (choice.empty()) throw BadInput(place, "expected one of the log's topics: " + list);
  const auto found = topics.find(choice);
  if (found == topics.end())
    throw BadInput(
        place, "expected one of the log's topics: " + list + "; found '" + choice + "'" + did_you_mean(choice, names));
  return found;
}

void reverse(LoggedScan& scan) {
  std::reverse(scan.range_m.begin(), scan.range_m.end());
  const double last = scan.first_angle_rad + static_cast<double>(scan.range_m.size() - 1) * scan.angle_step_rad;
  scan.first_angle_rad = last;
  scan.angle_step_rad = -scan.angle_step_rad;
}

// Seen from below, angles count the other way.
void turn_over(LoggedScan& scan) {
  scan.first_angle_rad = -scan.first_angle_rad;
  scan.angle_step_rad = -scan.angle_step_rad;
}

}  // namespace

void TopicLog::add(const std::string& topic, const std::string& type, Encoding encoding, std::string_view message) {
  const bool is_of_scans = is_scan(type), is_of_odometry = is_odometry(topic, type), is_of_frames = is_frames(type);
  if (!is_of_scans && !is_of_odometry && !is_of_frames) {
    ++others_[printable_line(topic)];
    return;
  }
  const std::string place =
      name_ + ": message " + std::to_string(++messages_[topic]) + " of '" + printable_line(topic) + "'";
  if (is_of_scans) add_scan(place, topic, encoding, message);
  if (is_of_odometry) add_odometry(place, topic, encoding, message);
  if (is_of_frames) add_frames(place, encoding, message);
}

void TopicLog::add_scan(const std::string& place, const std::string& topic, Encoding encoding,
                        std::string_view message) {
  ScanMessage read = parse_scan(place, encoding, message);
  if (read.range_m.empty()) return;
  Scans& of = scans_[topic];
  of.frame = without_slash(read.frame);
  for (float& range : read.range_m)
    if (std::isnan(range) || range < read.range_min_m) range = std::numeric_limits<float>::infinity();
  of.scans.push_back({read.stamp, places_++, read.first_angle_rad, read.angle_step_rad, read.range_max_m,
                      std::move(read.range_m), std::nullopt});
}

void TopicLog::add_odometry(const std::string& place, const std::string& topic, Encoding encoding,
                            std::string_view message) {
  const OdometryMessage read = parse_odometry(place, encoding, message);
  Odometry& of = odometry_[topic];
  of.child = without_slash(read.child);
  of.reports.push_back({read.stamp, places_++, read.pose});
}

void TopicLog::add_frames(const std::string& place, Encoding encoding, std::string_view message) {
  for (FrameMessage& read : parse_frames(place, encoding, message)) {
    read.frame.parent = without_slash(read.frame.parent);
    add_frame(read.stamp, without_slash(read.child), read.frame);
  }
}

void TopicLog::add_frame(Time stamp, const std::string& child, const SpaceFrame& frame) {
  if (frame.parent == "odom") {
    Odometry& of = odometry_of_frames_["odom -> " + child];
    of.child = child;
    of.reports.push_back({stamp, places_++, {frame.x, frame.y, heading_of(frame.qx, frame.qy, frame.qz, frame.qw)}});
  }
  frames_.try_emplace(child, frame);
}

void TopicLog::find_mount(const Scans& scans, const std::string& base, SensorLog& log) const {
  Eigen::Isometry3d laser = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Isometry3d> on_parent, on_base;
  std::string frame = scans.frame;
  for (std::size_t steps = 0; steps < frames_.size() && !on_base; ++steps) {
    const auto above = frames_.find(frame);
    if (above == frames_.end()) break;
    laser = transform_of(above->second) * laser;
    frame = above->second.parent;
    if (!on_parent) on_parent = laser;
    if (frame == base) on_base = laser;
  }
  if (frame != base && !on_parent) return;
  const Eigen::Isometry3d mount = on_base ? *on_base : on_parent.value_or(Eigen::Isometry3d::Identity());
  const Eigen::Matrix3d turn = mount.rotation();
  log.mount = {mount.translation().x(), mount.translation().y(), exact::atan2(turn(1, 0), turn(0, 0))};
  if (turn(2, 2) < 0)
    for (LoggedScan& scan : log.scans) turn_over(scan);
}

SensorLog TopicLog::finish(const std::string& format, const LogChoice& choice) {
  if (!choice.robot.empty()) throw BadInput(choice.robot_place, "only a log of CARMEN has robots: expected none");
  if (scans_.empty()) throw BadInput(name_, "expected a recording with scans (LaserScan), found none");
  auto& odometries = odometry_.empty() ? odometry_of_frames_ : odometry_;
  if (odometries.empty()) throw BadInput(name_, "expected odometry (nav_msgs Odometry, or frames of odom), found none");
  const auto scans = chosen(scans_, choice.scan, choice.scan_place);
  const auto odometry = chosen(odometries, choice.odometry, choice.odometry_place);
  SensorLog log;
  log.format = format;
  log.laser = printable_line(scans->first);
  log.left_out = others_;
  log.scans = std::move(scans->second.scans);
  log.odometry = std::move(odometry->second.reports);
  find_mount(scans->second, odometry->second.child, log);
  float greatest = 0;
  for (const LoggedScan& scan : log.scans)
    for (const float range : scan.range_m)
      if (std::isfinite(range)) greatest = std::max(greatest, range);
  for (LoggedScan& scan : log.scans) {
    if (scan.angle_step_rad < 0) reverse(scan);
    if (!(scan.range_max_m > 0)) scan.range_max_m = greatest;
    for (float& range : scan.range_m) range = std::min(range, static_cast<float>(scan.range_max_m));
  }
  return log;
}

}  // namespace waitpoint::logs
