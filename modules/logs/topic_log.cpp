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
#include "modules/logs/message_values.hpp"
#include "modules/messages/poses.hpp"

namespace waitpoint::logs {
namespace {

// ROS 1 knew names of frames with and without a slash.
std::string without_slash(const std::string& frame) { return frame.starts_with('/') ? frame.substr(1) : frame; }

Eigen::Isometry3d isometry_of(const messages::geometry_msgs::Transform& transform) {
  const messages::geometry_msgs::Quaternion& turn = transform.rotation;
  const double length =
      std::sqrt(exact::square(turn.w) + exact::square(turn.x) + exact::square(turn.y) + exact::square(turn.z));
  const Eigen::Quaterniond rotation =
      length > 0 ? Eigen::Quaterniond(turn.w / length, turn.x / length, turn.y / length, turn.z / length)
                 : Eigen::Quaterniond::Identity();
  return Eigen::Translation3d(transform.translation.x, transform.translation.y, transform.translation.z) * rotation;
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

std::string TopicLog::next_place(const std::string& topic) {
  return name_ + ": message " + std::to_string(++messages_[topic]) + " of '" + printable_line(topic) + "'";
}

void TopicLog::add(const RecordedMessage& message) {
  namespace foxglove = messages::foxglove;
  if (message.is<messages::sensor_msgs::LaserScan>()) {
    const std::string place = next_place(message.topic);
    const auto read = message.read<messages::sensor_msgs::LaserScan>(place);
    add_scan(message, read.header.frame_id, scan_of(place, read));
  } else if (message.is<foxglove::LaserScan>()) {
    const std::string place = next_place(message.topic);
    const auto read = message.read<foxglove::LaserScan>(place);
    add_scan(message, read.frame_id, scan_of(place, read));
  } else if (message.is<messages::nav_msgs::Odometry>()) {
    const std::string place = next_place(message.topic);
    const auto read = message.read<messages::nav_msgs::Odometry>(place);
    add_odometry(message, read.child_frame_id, time_of(read.header.stamp),
                 messages::pose_of(checked(place, read.pose.pose)));
  } else if (message.is<foxglove::PoseInFrame>() && message.topic.ends_with("odometry")) {
    const std::string place = next_place(message.topic);
    const auto read = message.read<foxglove::PoseInFrame>(place);
    add_odometry(message, "", time_of(read.timestamp), messages::pose_of(checked(place, read.pose)));
  } else if (message.is<messages::tf2_msgs::TFMessage>() || message.type == "tf/tfMessage") {
    const std::string place = next_place(message.topic);
    for (const auto& frame : message.read<messages::tf2_msgs::TFMessage>(place).transforms)
      add_frame(message, place, frame);
  } else if (message.is<foxglove::FrameTransform>()) {
    const std::string place = next_place(message.topic);
    const auto read = message.read<foxglove::FrameTransform>(place);
    add_frame(message, place,
              {{0, read.timestamp, read.parent_frame_id}, read.child_frame_id, {read.translation, read.rotation}});
  } else {
    ++others_[printable_line(message.topic)];
  }
}

void TopicLog::add_scan(const RecordedMessage& message, const std::string& frame, LoggedScan scan) {
  if (scan.range_m.empty()) return;
  Scans& of = scans_[message.topic];
  of.frame = without_slash(frame);
  scan.received = message.received;
  scan.place = places_++;
  of.scans.push_back(std::move(scan));
}

void TopicLog::add_odometry(const RecordedMessage& message, const std::string& child, Time stamp, const Pose& pose) {
  Odometry& of = odometry_[message.topic];
  of.child = without_slash(child);
  of.reports.push_back({stamp, places_++, pose, message.received});
}

void TopicLog::add_frame(const RecordedMessage& message, const std::string& place,
                         const messages::geometry_msgs::TransformStamped& frame) {
  const messages::geometry_msgs::Transform& transform = checked(place, frame.transform);
  const std::string parent = without_slash(frame.header.frame_id), child = without_slash(frame.child_frame_id);
  if (parent == "odom") {
    Odometry& of = odometry_of_frames_["odom -> " + child];
    of.child = child;
    const Pose pose{transform.translation.x, transform.translation.y, messages::heading_of(transform.rotation)};
    of.reports.push_back({time_of(frame.header.stamp), places_++, pose, message.received});
  }
  const auto [known, is_new] = frames_.try_emplace(child, Frame{message.received, parent, transform});
  if (!is_new && message.received < known->second.received) known->second = {message.received, parent, transform};
}

void TopicLog::find_mount(const Scans& scans, const std::string& base, SensorLog& log) const {
  Eigen::Isometry3d laser = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Isometry3d> on_parent, on_base;
  std::string frame = scans.frame;
  for (std::size_t steps = 0; steps < frames_.size() && !on_base; ++steps) {
    const auto above = frames_.find(frame);
    if (above == frames_.end()) break;
    laser = isometry_of(above->second.transform) * laser;
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
