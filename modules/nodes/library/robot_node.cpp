// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/robot_node.hpp"

#include "core/exact_math.hpp"
#include "modules/nodes/library/messages.hpp"

namespace waitpoint::nodes {
namespace {

constexpr std::uint32_t queue = 10;
constexpr bool latched = true;
constexpr const char* map_frame = "map";

/// The frame from which a place that is `in_other` there is seen where it is `here`.
Place frame_of(const Place& here, const Place& in_other) {
  const double heading = here.heading - in_other.heading;
  const double c = exact::cos(heading), s = exact::sin(heading);
  return {here.x - (c * in_other.x - s * in_other.y), here.y - (s * in_other.x + c * in_other.y), heading, 0};
}

}  // namespace

RobotNode::RobotNode(const RobotTopics& topics) : topics_(topics), node_(topics.space) {
  for (const LaserTopic& laser : topics.lasers)
    scans_.push_back(node_.advertise<sensor_msgs::LaserScan>(laser.topic, queue));
  for (const SonarTopic& ring : topics.sonars)
    sonars_.push_back(
        node_.advertise<sensor_msgs::Range>(ring.topic, queue * static_cast<std::uint32_t>(ring.frames.size())));
  odometry_ = node_.advertise<nav_msgs::Odometry>("odom", queue);
  truth_ = node_.advertise<nav_msgs::Odometry>("base_pose_ground_truth", queue);
  if (topics.has_imu) imu_ = node_.advertise<sensor_msgs::Imu>("imu", queue);
  battery_ = node_.advertise<sensor_msgs::BatteryState>("battery", queue, latched);
  goal_ = node_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", queue, latched);
  start_ = node_.advertise<geometry_msgs::PoseWithCovarianceStamped>("initialpose", 1, latched);
  posters_.resize(topics.posters.size());
  if (topics.takes_pose)
    pose_ = node_.subscribe<geometry_msgs::PoseWithCovarianceStamped>(
        "pose", queue, [this](const geometry_msgs::PoseWithCovarianceStamped::ConstPtr& pose) { taken_pose_ = pose; });
  drive_ = node_.subscribe<geometry_msgs::Twist>("cmd_vel", queue,
                                                 [this](const geometry_msgs::Twist::ConstPtr& twist) { take(*twist); });
}

void RobotNode::take(const geometry_msgs::Twist& twist) {
  const std::uint32_t before = command_ ? command_->messages : 0;
  command_ = Command{{twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.z}, before + 1};
}

void RobotNode::publish(std::int64_t now_ns, const ros::Time& stamp, const RobotReadings& readings,
                        tf2_msgs::TFMessage& tf) {
  const std::string odom = topics_.prefix + "odom", base = topics_.prefix + "base_link";
  if (readings.has_odometry) {
    add_transforms(stamp, readings, tf);
    odometry_.publish(odometry(stamp, odom, base, readings.odometry, readings.odometry_covariance, readings.measured));
    truth_.publish(odometry(stamp, map_frame, base, readings.truth, {}, readings.speeds));
  }
  for (const ScanReading& reading : readings.scans) {
    const ros::Time date = stamp - ros::Duration().fromNSec(now_ns - reading.date_ns);
    scans_[reading.laser].publish(scan(date, topics_.lasers[reading.laser], reading));
  }
  for (const SonarReading& reading : readings.sonars)
    for (std::size_t i = 0; i < reading.ranges.size(); ++i)
      sonars_[reading.ring].publish(range(stamp, topics_.sonars[reading.ring], i, reading.ranges[i]));
  if (readings.imu) imu_.publish(imu(stamp, base, *readings.imu));
  if (readings.battery) battery_.publish(battery(stamp, *readings.battery));
  for (const PosterReading& reading : readings.posters)
    publish(stamp - ros::Duration().fromNSec(now_ns - reading.date_ns), reading);
}

void RobotNode::publish(const ros::Time& stamp, const PosterReading& reading) {
  ros::Publisher& topic = posters_[reading.topic];
  const auto send = [&](const auto& message) {
    using Message = std::decay_t<decltype(message)>;
    if (!topic) topic = node_.advertise<Message>(topics_.posters[reading.topic], queue);
    topic.publish(message);
  };
  const std::string base = topics_.prefix + "base_link";
  if (const auto* pose = std::get_if<PoseReading>(&reading.value)) {
    send(pose_with_covariance(stamp, map_frame, *pose));
  } else if (const auto* motion = std::get_if<OdometryReading>(&reading.value)) {
    send(odometry(stamp, topics_.prefix + "modules_odom", base, motion->place, motion->covariance, motion->speeds));
  } else if (const auto* echoes = std::get_if<EchoesReading>(&reading.value)) {
    const LaserTopic laser{"",
                           topics_.lasers.empty() ? base : topics_.lasers.front().frame,
                           {},
                           echoes->range_max,
                           topics_.lasers.empty() ? 0 : topics_.lasers.front().period_s};
    send(scan(stamp, laser, {0, reading.date_ns, echoes->first_angle, echoes->angle_step, echoes->ranges}));
  } else if (const auto* speeds = std::get_if<Speeds>(&reading.value)) {
    send(twist_of(*speeds));
  } else {
    send(imu(stamp, base, std::get<ImuReading>(reading.value)));
  }
}

std::optional<PublishedPose> RobotNode::take_pose(const ros::Time& begin) {
  const auto taken = std::exchange(taken_pose_, nullptr);
  if (taken == nullptr) return std::nullopt;
  return PublishedPose{(taken->header.stamp - begin).toNSec(), pose_reading(*taken)};
}

void RobotNode::add_transforms(const ros::Time& stamp, const RobotReadings& readings, tf2_msgs::TFMessage& tf) const {
  const std::string odom = topics_.prefix + "odom";
  if (topics_.gives_map_to_odom)
    tf.transforms.push_back(transform(stamp, map_frame, odom, frame_of(readings.truth, readings.odometry)));
  tf.transforms.push_back(transform(stamp, odom, topics_.prefix + "base_link", readings.odometry));
}

void RobotNode::add_fixed(const ros::Time& stamp, tf2_msgs::TFMessage& tf) const {
  const std::string base = topics_.prefix + "base_link";
  for (const LaserTopic& laser : topics_.lasers)
    tf.transforms.push_back(transform(stamp, base, laser.frame, laser.mount));
  for (const SonarTopic& ring : topics_.sonars)
    for (std::size_t i = 0; i < ring.frames.size(); ++i)
      tf.transforms.push_back(transform(stamp, base, ring.frames[i], ring.mounts[i]));
}

void RobotNode::send_goal(const ros::Time& stamp, const Place& goal) { goal_.publish(pose_in(stamp, map_frame, goal)); }

void RobotNode::send_start(const ros::Time& stamp) {
  constexpr double variance_m2 = 0.05 * 0.05, variance_rad2 = 0.05 * 0.05;
  start_.publish(pose_with_covariance(stamp, map_frame,
                                      {topics_.start, {variance_m2, 0, 0, 0, variance_m2, 0, 0, 0, variance_rad2}}));
}

}  // namespace waitpoint::nodes
