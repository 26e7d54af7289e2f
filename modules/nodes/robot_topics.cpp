// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/robot_topics.hpp"

#include <algorithm>

#include "modules/messages/poses.hpp"
#include "modules/messages/readings.hpp"

namespace waitpoint::nodes {
namespace {

constexpr std::uint32_t queue = 10;
constexpr Duration odometry_period = std::chrono::milliseconds(50);
constexpr const char* map_frame = "map";

std::string prefix_of(const scenario::NodesScenario& nodes) {
  return nodes.tf_prefix.empty() ? "" : nodes.tf_prefix + "/";
}

/// The frame from which a place that is `in_other` there is seen where it is `here`.
Pose frame_of(const Pose& here, const Pose& in_other) {
  const double heading = here.heading - in_other.heading;
  const double c = exact::cos(heading), s = exact::sin(heading);
  return {here.x - (c * in_other.x - s * in_other.y), here.y - (s * in_other.x + c * in_other.y), heading};
}

messages::geometry_msgs::Twist twist_of(const world::Velocity& velocity) {
  return {{velocity.v_m_s, velocity.side_m_s, velocity.climb_m_s}, {0, 0, velocity.w_rad_s}};
}

}  // namespace

RobotTopics::RobotTopics(NodeSide& nodes, const scenario::Scenario& scenario, std::size_t robot)
    : nodes_(nodes),
      scenario_(scenario),
      robot_(scenario.robots[robot]),
      id_(static_cast<world::BodyId>(robot)),
      space_(robot_.nodes->ns),
      prefix_(prefix_of(*robot_.nodes)),
      base_(prefix_ + "base_link"),
      odom_(prefix_ + "odom"),
      begin_(nodes.begin()),
      dead_reckoning_(rflex::OdometryNoise{}, robot_.body.base.odometry.units_per_m,
                      robot_.body.base.odometry.units_per_rad),
      sensors_(nodes, robot_, scenario.step, prefix_, [this](const std::string& topic) { return global(topic); }),
      odometry_(nodes, global("odom"), queue),
      truth_(nodes, global("base_pose_ground_truth"), queue),
      goal_(nodes, global("move_base_simple/goal"), queue, latched),
      start_(nodes, global("initialpose"), 1, latched) {
  if (scenario::takes_pose(robot_))
    pose_subscription_ = nodes.subscribe(
        global("pose"), messages::ros1_type<messages::geometry_msgs::PoseWithCovarianceStamped>(), queue);
  command_subscription_ =
      nodes.subscribe(global("cmd_vel"), messages::ros1_type<messages::geometry_msgs::Twist>(), queue);
  for (const scenario::ShownTopic& shown : scenario::shown_topics(*robot_.nodes)) {
    const auto kind = static_cast<ShownMessage::Kind>(shown.kind);
    const std::string name = global(shown.topic);
    shown_.push_back({nodes.subscribe(name, shown_type(kind), queue), name, kind});
  }
}

std::string RobotTopics::global(const std::string& topic) const {
  if (topic.starts_with('/')) return topic;
  return space_.ends_with('/') ? space_ + topic : space_ + "/" + topic;
}

void RobotTopics::begin(const genom::NameSpace& names) {
  const bool has_laser = !robot_.laser_names.empty();
  posters_.emplace(*robot_.nodes, names,
                   PosterFrames{prefix_, has_laser ? prefix_ + robot_.laser_names.front() : base_,
                                has_laser ? robot_.body.sensors<world::Lasers>().front().period.seconds() : 0, begin_});
}

void RobotTopics::publish(const world::World& world, Time now, messages::tf2_msgs::TFMessage& tf) {
  now_ = now;
  publish_odometry(world, tf);
  sensors_.publish(world, id_, stamp(now_));
  if (posters_) posters_->publish(nodes_, [this](const std::string& topic) { return global(topic); });
}

void RobotTopics::publish_odometry(const world::World& world, messages::tf2_msgs::TFMessage& tf) {
  const world::BodyState& body = world.body(id_);
  const world::OdometerReading& odometer = world.odometer(id_);
  dead_reckoning_.advance(now_, odometer.travel_units, odometer.turn_units, odometer.side_units);
  if (world::times_due(odometry_period, scenario_.step, world.steps()) == 0) return;
  const posters::PositionEstimate& position = dead_reckoning_.position();
  const auto transform = [&](const std::string& parent, const std::string& child, const Pose& pose, double z_m) {
    auto& added = tf.transforms.emplace_back(messages::transform_message(now_, parent, child, pose, z_m));
    added.header.stamp = stamp(now_);
  };
  if (robot_.nodes->gives_map_to_odom) transform(map_frame, odom_, frame_of(body.pose, position.pose), 0);
  transform(odom_, base_, position.pose, body.height_m);
  const messages::std_msgs::Header in_odom{0, stamp(now_), odom_}, in_map{0, stamp(now_), map_frame};
  odometry_.publish(
      {in_odom,
       base_,
       {messages::pose_message(position.pose, body.height_m), messages::space_covariance(position.covariance)},
       {twist_of(odometer.velocity), {}}});
  truth_.publish(
      {in_map, base_, {messages::pose_message(body.pose, body.height_m), {}}, {twist_of(body.velocity), {}}});
}

void RobotTopics::add_fixed(messages::tf2_msgs::TFMessage& tf) const { sensors_.add_fixed(tf, base_, stamp(Time())); }

void RobotTopics::send_start() const {
  constexpr double variance_m2 = 0.05 * 0.05, variance_rad2 = 0.05 * 0.05;
  start_.publish({{0, stamp(Time()), map_frame},
                  {messages::pose_message(robot_.body.start),
                   messages::space_covariance({variance_m2, 0, 0, 0, variance_m2, 0, 0, 0, variance_rad2})}});
}

void RobotTopics::send_goal(const Pose& goal) const {
  goal_.publish({{0, stamp(now_), map_frame}, messages::pose_message(goal)});
}

bool RobotTopics::take(const NodeSide::Received& received, ShownTopics* shown) {
  using messages::Wire;
  if (received.subscription == command_subscription_) {
    const std::uint32_t before = command_ ? command_->messages : 0;
    command_ = {messages::decode<messages::geometry_msgs::Twist, Wire::ros1>("a message of cmd_vel", received.bytes),
                before + 1};
    return true;
  }
  if (received.subscription == pose_subscription_) {
    const auto message = messages::decode<messages::geometry_msgs::PoseWithCovarianceStamped, Wire::ros1>(
        "a message of pose", received.bytes);
    pose_ = {Time() + (messages::time_of(message.header.stamp) - begin_), messages::pose_of(message.pose.pose),
             messages::plane_covariance(message.pose.covariance)};
    return true;
  }
  const auto subscribed = std::find_if(shown_.begin(), shown_.end(),
                                       [&](const Shown& each) { return each.subscription == received.subscription; });
  if (subscribed == shown_.end()) return false;
  if (shown != nullptr) shown->add(shown_message(subscribed->kind, subscribed->topic, received.bytes, begin_));
  return true;
}

}  // namespace waitpoint::nodes
