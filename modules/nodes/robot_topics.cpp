// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/robot_topics.hpp"

#include <algorithm>

#include "modules/messages/poses.hpp"
#include "modules/messages/readings.hpp"
#include "modules/outside/sensor_times.hpp"

namespace waitpoint::nodes {
namespace {

constexpr std::uint32_t queue = 10;
constexpr bool latched = true;
constexpr Duration odometry_period = std::chrono::milliseconds(50), battery_period = std::chrono::seconds(1);
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

std::string sonar_name(std::size_t ring) { return ring == 0 ? "sonar" : "sonar_" + std::to_string(ring); }

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
      lasers_(advertised_lasers()),
      sonars_(advertised_sonars()),
      odometry_(nodes, global("odom"), queue),
      truth_(nodes, global("base_pose_ground_truth"), queue),
      imu_(robot_.body.sensors<world::Imu>()
               ? std::optional<TypedTopic<messages::sensor_msgs::Imu>>({nodes, global("imu"), queue})
               : std::nullopt),
      battery_(nodes, global("battery"), queue, latched),
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

std::vector<RobotTopics::Laser> RobotTopics::advertised_lasers() const {
  std::vector<Laser> lasers;
  const bool is_single = robot_.body.sensors<world::Lasers>().size() == 1;
  for (const std::string& name : robot_.laser_names)
    lasers.push_back({{nodes_, global(is_single ? "scan" : name), queue}, prefix_ + name});
  return lasers;
}

std::vector<RobotTopics::SonarRing> RobotTopics::advertised_sonars() const {
  std::vector<SonarRing> rings;
  for (const world::SonarRingDescription& ring : robot_.body.sensors<world::Sonars>()) {
    const std::string name = sonar_name(rings.size());
    SonarRing& added = rings.emplace_back(SonarRing{{nodes_, global(name), queue * ring.count}, {}});
    for (std::uint32_t i = 0; i < ring.count; ++i) added.frames.push_back(prefix_ + name + "_" + std::to_string(i));
  }
  return rings;
}

void RobotTopics::begin(const genom::NameSpace& names) {
  const bool has_laser = !lasers_.empty();
  posters_.emplace(*robot_.nodes, names,
                   PosterFrames{prefix_, has_laser ? lasers_.front().frame : base_,
                                has_laser ? robot_.body.sensors<world::Lasers>().front().period.seconds() : 0, begin_});
}

bool RobotTopics::is_due(Duration period, const world::World& world) const {
  return outside::is_due(period, scenario_.step, world.steps());
}

void RobotTopics::publish(const world::World& world, Time now, messages::tf2_msgs::TFMessage& tf) {
  now_ = now;
  publish_odometry(world, tf);
  publish_scans(world);
  publish_sonars(world);
  publish_body(world);
  if (posters_) posters_->publish(nodes_, [this](const std::string& topic) { return global(topic); });
}

void RobotTopics::publish_odometry(const world::World& world, messages::tf2_msgs::TFMessage& tf) {
  const world::BodyState& body = world.body(id_);
  const world::OdometerReading& odometer = world.odometer(id_);
  dead_reckoning_.advance(now_, odometer.travel_units, odometer.turn_units, odometer.side_units);
  if (!is_due(odometry_period, world)) return;
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

void RobotTopics::publish_scans(const world::World& world) {
  for (std::size_t i = 0; i < lasers_.size(); ++i) {
    const world::LaserDescription& laser = robot_.body.sensors<world::Lasers>()[i];
    if (!is_due(laser.period, world)) continue;
    world::LaserScan scan;
    world.scan(id_, i, ++lasers_[i].scans, scan);
    messages::sensor_msgs::LaserScan message = messages::scan_message(
        now_, lasers_[i].frame, scan.first_angle_rad, scan.angle_step_rad, scan.range_m.size(), laser.range_max_m);
    message.header.stamp = stamp(now_);
    message.scan_time = static_cast<float>(laser.period.seconds());
    for (const double range_m : scan.range_m)
      message.ranges.push_back(messages::range_or_infinity(range_m, laser.range_max_m));
    lasers_[i].topic.publish(message);
  }
}

void RobotTopics::publish_sonars(const world::World& world) {
  using messages::sensor_msgs::Range;
  for (std::size_t ring = 0; ring < sonars_.size(); ++ring) {
    const world::SonarRingDescription& sonars = robot_.body.sensors<world::Sonars>()[ring];
    if (!is_due(sonars.period, world)) continue;
    std::vector<double> ranges;
    const std::size_t turns = std::max<std::size_t>(sonars.firing_order.size(), 1);
    for (std::size_t turn = 0; turn < turns; ++turn) world.sonar(id_, ring, ++sonars_[ring].firings, ranges);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      Range message;
      message.header = {0, stamp(now_), sonars_[ring].frames[i]};
      message.radiation_type = messages::constant<Range>("ULTRASOUND");
      message.field_of_view = static_cast<float>(2 * sonars.half_cone_rad);
      message.min_range = static_cast<float>(sonars.range_min_m);
      message.max_range = static_cast<float>(sonars.range_max_m);
      message.range = messages::range_or_infinity(ranges[i], sonars.range_max_m);
      sonars_[ring].topic.publish(message);
    }
  }
}

void RobotTopics::publish_body(const world::World& world) {
  if (imu_ && world.read<world::Imu>(id_, 0, imu_sample_)) {
    imu_sample_.date = now_;
    messages::sensor_msgs::Imu message = messages::message_of(imu_sample_, base_);
    message.header.stamp = stamp(now_);
    imu_->publish(message);
  }
  if (!is_due(battery_period, world)) return;
  using messages::sensor_msgs::BatteryState;
  const world::BatteryState battery = world.battery(id_);
  BatteryState message;
  message.header.stamp = stamp(now_);
  message.voltage = static_cast<float>(battery.volts);
  message.current = static_cast<float>(-battery.current_a);  // negative: it discharges
  message.percentage = static_cast<float>(battery.charge);
  message.charge = message.capacity = message.design_capacity = std::numeric_limits<float>::quiet_NaN();
  message.power_supply_status = messages::constant<BatteryState>("POWER_SUPPLY_STATUS_DISCHARGING");
  message.present = true;
  battery_.publish(message);
}

void RobotTopics::add_fixed(messages::tf2_msgs::TFMessage& tf) const {
  const auto add = [&](const std::string& frame, const Pose& mount, double height_m) {
    auto& added = tf.transforms.emplace_back(messages::transform_message(Time(), base_, frame, mount, height_m));
    added.header.stamp = stamp(Time());
  };
  for (std::size_t i = 0; i < lasers_.size(); ++i)
    add(lasers_[i].frame, robot_.body.sensors<world::Lasers>()[i].mount,
        robot_.body.sensors<world::Lasers>()[i].height_m);
  for (std::size_t ring = 0; ring < sonars_.size(); ++ring) {
    const world::SonarRingDescription& sonars = robot_.body.sensors<world::Sonars>()[ring];
    for (std::uint32_t i = 0; i < sonars.count; ++i) {
      const double heading = exact::wrap_angle(2 * exact::pi * i / sonars.count);
      const Pose mount{sonars.ring_radius_m * exact::cos(heading), sonars.ring_radius_m * exact::sin(heading), heading};
      add(sonars_[ring].frames[i], mount, sonars.height_m);
    }
  }
}

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
