// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/world_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/number_text.hpp"
#include "modules/nodes/shown_readings.hpp"
#include "modules/nodes/world_topics.hpp"
#include "modules/outside/sensor_times.hpp"
#include "modules/outside/words.hpp"

namespace waitpoint::nodes {
namespace {

constexpr double arrived_m = 0.5;  // from the goal
constexpr double at_rest_m_s = 0.1;
constexpr double no_turn_rad_s = 0.02;
constexpr Duration patience = std::chrono::minutes(5), repetition = std::chrono::seconds(10);
constexpr Duration odometry_period = std::chrono::milliseconds(50), battery_period = std::chrono::seconds(1);
constexpr std::uint32_t messages_per_s_at_most = 500;  // a controller sends 10 to 100
constexpr const char* place = "nodes";

// Of the numbers of an intervention, besides 0 (genom/settings.hpp).
constexpr double number_least = 1e-12, number_most = 1e4;

bool is_usable(double number) { return std::fabs(number) <= number_most; }
/// As interventions take it: the errors of rounding in a message are 0.
double rounded(double number) { return std::fabs(number) < number_least ? 0 : number; }

bool are_usable(const Speeds& speeds) {
  return is_usable(speeds.ahead) && is_usable(speeds.left) && is_usable(speeds.up) && is_usable(speeds.turn);
}

bool is_usable(const PoseReading& pose) {
  const auto& all = pose.covariance;  // of x, y, heading, in row order
  const auto is_covariance = [&](std::size_t i, std::size_t k) {
    return all[3 * i + k] * all[3 * i + k] <= all[4 * i] * all[4 * k];
  };
  return is_usable(pose.place.x) && is_usable(pose.place.y) && is_usable(pose.place.heading) &&
         std::all_of(all.begin(), all.end(), [](double number) { return is_usable(number); }) &&
         std::min({all[0], all[4], all[8]}) >= number_least && is_covariance(0, 1) && is_covariance(0, 2) &&
         is_covariance(1, 2);
}

Speeds speeds_of(const world::Velocity& velocity) {
  return {velocity.v_m_s, velocity.side_m_s, velocity.climb_m_s, velocity.w_rad_s};
}

}  // namespace

WorldNode::WorldNode(const scenario::Scenario& scenario, const std::vector<std::size_t>& robots,
                     std::unique_ptr<NodeSide> nodes, std::vector<NodeCommand> commands, NodeRunOptions options)
    : scenario_(scenario),
      nodes_(std::move(nodes)),
      air_(scenario, robots),
      shown_(std::move(options.shown)),
      is_brief_(options.is_brief),
      processes_(std::move(commands), *nodes_, options.is_brief ? NodeEnds::killed : NodeEnds::asked,
                 std::move(options.environment)),
      expectations_(scenario.expect) {
  robots_.reserve(robots.size());
  for (const std::size_t index : robots) {
    const world::BodyDescription& body = scenario.robots[index].body;
    const world::OdometryErrors& units = body.base.odometry;
    robots_.push_back({.index = index, .odometry = {rflex::OdometryNoise{}, units.units_per_m, units.units_per_rad}});
    robots_.back().scans.resize(body.lasers.size());
    robots_.back().firings.resize(body.sonars.size());
  }
}

void WorldNode::begin(outside::Host& host) {
  for (Robot& robot : robots_)
    robot.posters.emplace(scenario::poster_topics(*scenario_.robots[robot.index].nodes),
                          host.experiment().robots()[robot.index]->names());
  publish(host);
}

void WorldNode::publish(outside::Host& host) {
  const world::World& world = host.experiment().world();
  if (published_ == world.steps()) return;
  published_ = world.steps();
  const Time now = Time() + scenario_.step * static_cast<std::int64_t>(world.steps());
  std::vector<RobotReadings> all;
  all.reserve(robots_.size());
  for (Robot& robot : robots_) all.push_back(readings(robot, world, now));
  air_.move(world);
  nodes_->publish(now.since_start().ns(), all);
}

RobotReadings WorldNode::readings(Robot& robot, const world::World& world, Time now) {
  const auto id = static_cast<world::BodyId>(robot.index);
  const world::BodyState& body = world.body(id);
  const world::OdometerReading& odometer = world.odometer(id);
  robot.odometry.advance(now, odometer.travel_units, odometer.turn_units, odometer.side_units);
  const posters::PositionEstimate& position = robot.odometry.position();
  RobotReadings readings;
  readings.has_odometry = outside::is_due(odometry_period, scenario_.step, world.steps());
  readings.truth = place_of(body.pose, body.height_m);
  readings.speeds = speeds_of(body.velocity);
  readings.odometry = place_of(position.pose, body.height_m);
  readings.odometry_covariance = position.covariance;
  readings.measured = speeds_of(odometer.velocity);
  read_sensors(robot, world, now, readings);
  if (robot.posters) robot.posters->read(readings.posters);
  return readings;
}

void WorldNode::read_sensors(Robot& robot, const world::World& world, Time now, RobotReadings& readings) {
  const auto id = static_cast<world::BodyId>(robot.index);
  const world::BodyDescription& body = scenario_.robots[robot.index].body;
  const auto is_due = [&](Duration period) { return outside::is_due(period, scenario_.step, world.steps()); };
  for (std::size_t laser = 0; laser < body.lasers.size(); ++laser) {
    if (!is_due(body.lasers[laser].period)) continue;
    world::LaserScan scan;
    world.scan(id, laser, ++robot.scans[laser], scan);
    readings.scans.push_back({laser, now.since_start().ns(), scan.first_angle_rad, scan.angle_step_rad, scan.range_m});
  }
  for (std::size_t ring = 0; ring < body.sonars.size(); ++ring) {
    if (!is_due(body.sonars[ring].period)) continue;
    SonarReading& reading = readings.sonars.emplace_back(SonarReading{ring, {}});
    const std::size_t turns = std::max<std::size_t>(body.sonars[ring].firing_order.size(), 1);
    for (std::size_t turn = 0; turn < turns; ++turn) world.sonar(id, ring, ++robot.firings[ring], reading.ranges);
  }
  if (body.imu && world.imu(id).number != robot.imu_samples) {
    const world::ImuSample& sample = world.imu(id);
    robot.imu_samples = sample.number;
    readings.imu = {sample.turn_rad_s, sample.ahead_m_s2, sample.left_m_s2, sample.up_m_s2};
  }
  if (is_due(battery_period)) {
    const world::BatteryState battery = world.battery(id);
    readings.battery = {battery.volts, battery.current_a, battery.charge};
  }
}

void WorldNode::take_in(outside::Host& host) {
  const std::vector<std::optional<Command>> commands = nodes_->take_commands();
  const std::vector<std::optional<PublishedPose>> poses = nodes_->take_poses();
  const bool is_new_second = host.next_step() >= second_ + Duration(std::chrono::seconds(1));
  if (is_new_second) second_ = host.next_step();
  processes_.go_on(host.next_step());
  tell_news(host);
  expectations_.watch(host, *nodes_);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (is_new_second) robots_[i].messages = 0;
    if (commands[i]) {
      count(host, robots_[i], commands[i]->messages);
      drive(host, robots_[i], commands[i]->speeds);
    }
    if (poses[i]) pass_pose(host, robots_[i], *poses[i]);
    show_goal(host, i);
    show_topics(i);
  }
  if (processes_.is_over() || (is_brief_ && expectations_.is_lost(host, processes_))) host.finish();
}

void WorldNode::show_topics(std::size_t robot) {
  for (const ShownReading& reading : nodes_->take_shown(robot)) shown_->add(message_of(reading));
}

void WorldNode::tell_news(outside::Host& host) {
  for (const NodeNews& news : processes_.take_news()) {
    if (!news.is_fault) {
      host.tell(news.node, news.text);
      continue;
    }
    faults_.add("faults of nodes");
    if (news.is_failure) expectations_.note_failure("node " + news.node + " " + news.text);
    host.tell_fault(news.node, news.text);
  }
}

void WorldNode::count(outside::Host& host, Robot& robot, std::uint32_t messages) {
  robot.messages += messages;
  if (robot.messages <= messages_per_s_at_most || !faults_.add("floods of speeds")) return;
  host.tell_fault(scenario_.robots[robot.index].name,
                  fmt::format("cmd_vel: expected at most {} messages a second, found more: of those that come within a "
                              "step of the world the last is obeyed",
                              messages_per_s_at_most));
}

void WorldNode::drive(outside::Host& host, const Robot& robot, const Speeds& speeds) {
  const std::string& name = scenario_.robots[robot.index].name;
  if (!are_usable(speeds)) {
    if (faults_.add("speeds that are no numbers, or too great"))
      host.tell_fault(name,
                      "cmd_vel: expected finite speeds of at most 10000, found others: such messages are not obeyed");
    return;
  }
  ++commands_;
  host.intervene(fmt::format("command {} v_m_s={} w_rad_s={} side_m_s={} climb_m_s={}", outside::quoted_word(name),
                             rounded(speeds.ahead), rounded(speeds.turn), rounded(speeds.left), rounded(speeds.up)),
                 {place, 0});
}

void WorldNode::pass_pose(outside::Host& host, const Robot& robot, const PublishedPose& published) {
  const std::string& name = scenario_.robots[robot.index].name;
  if (!is_usable(published.pose)) {
    if (faults_.add("poses that are no numbers"))
      host.tell_fault(name,
                      "pose: expected finite numbers of at most 10000 and a covariance, found others: such messages "
                      "are not taken");
    return;
  }
  ++poses_;
  const Place& at = published.pose.place;
  std::string text =
      fmt::format("pose {} date_s={} pose.x={} pose.y={} pose.heading={}", outside::quoted_word(name),
                  Duration::from_ns(published.date_ns).seconds(), rounded(at.x), rounded(at.y), rounded(at.heading));
  for (std::size_t i = 0; i < published.pose.covariance.size(); ++i)
    text += fmt::format(" covariance.{}={}", i, rounded(published.pose.covariance[i]));
  host.intervene(text, {place, 0});
}

// Goals are judged by the truth: a node's own opinion is not what the robot did.
void WorldNode::show_goal(outside::Host& host, std::size_t number) {
  Robot& robot = robots_[number];
  const scenario::RobotScenario& of = scenario_.robots[robot.index];
  if (!of.goals_are_for_nodes()) return;
  const bridge::Robot& driven = *host.experiment().robots()[robot.index];
  const std::optional<std::size_t> current = driven.current_goal();
  if (!current) return;
  const Time now = host.next_step();
  const world::BodyState& body = host.experiment().world().body(world::BodyId(robot.index));
  const Point goal = of.goals[*current].position;
  if (robot.goals_sent <= *current) {
    if (!nodes_->has_driver(number)) return;
    send_goal(number, goal, body, now);
    robot.goals_sent = *current + 1;
    robot.sent_at = now;
    ++goals_;
    return;
  }
  const bool is_at_rest = std::fabs(body.velocity.v_m_s) < at_rest_m_s;
  const bool has_arrived = length(goal - body.pose.position()) < arrived_m && is_at_rest;
  if (!is_at_rest || std::fabs(body.velocity.w_rad_s) > no_turn_rad_s) robot.told_at = now;
  // As a person would, who sees that nothing happens: a planner that starts can lose a goal, or give it up.
  if (!has_arrived && now - robot.told_at >= repetition) send_goal(number, goal, body, now);
  if (!has_arrived && now - robot.sent_at < patience) return;
  host.intervene("goal " + outside::quoted_word(of.name) + (has_arrived ? " reached" : " given-up"), {place, 0});
}

void WorldNode::send_goal(std::size_t number, const Point& position, const world::BodyState& body, Time now) {
  const Point away = position - body.pose.position();
  nodes_->send_goal(number, {position.x, position.y, exact::atan2(away.y, away.x), 0});
  robots_[number].told_at = now;
}

std::vector<std::string> WorldNode::unmet() const { return expectations_.unmet(processes_, *nodes_); }

std::string WorldNode::account() const {
  return "nodes: " + counted(goals_, "goal") + ", " + counted(commands_, "command") +
         (poses_ > 0 ? ", " + counted(poses_, "pose") : "") + air_.losses() + faults_.text();
}

}  // namespace waitpoint::nodes
