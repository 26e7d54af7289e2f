// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/world_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/number_text.hpp"
#include "modules/outside/words.hpp"

namespace waitpoint::nodes {
namespace {

constexpr double arrived_m = 0.5;  // from the goal
constexpr double at_rest_m_s = 0.1;
constexpr double no_turn_rad_s = 0.02;
constexpr Duration patience = std::chrono::minutes(5), repetition = std::chrono::seconds(10);
constexpr std::uint32_t messages_per_s_at_most = 500;  // a controller sends 10 to 100
constexpr const char* place = "nodes";

// Of the numbers of an intervention, besides 0 (genom/settings.hpp).
constexpr double number_least = 1e-12, number_most = 1e4;

bool is_usable(double number) { return std::fabs(number) <= number_most; }
/// As interventions take it: the errors of rounding in a message are 0.
double rounded(double number) { return std::fabs(number) < number_least ? 0 : number; }

bool are_usable(const messages::geometry_msgs::Twist& twist) {
  return is_usable(twist.linear.x) && is_usable(twist.linear.y) && is_usable(twist.linear.z) &&
         is_usable(twist.angular.z);
}

bool is_usable(const posters::PositionEstimate& position) {
  const auto& all = position.covariance;  // of x, y, heading, in row order
  const auto is_covariance = [&](std::size_t i, std::size_t k) {
    return all[3 * i + k] * all[3 * i + k] <= all[4 * i] * all[4 * k];
  };
  return is_usable(position.pose.x) && is_usable(position.pose.y) && is_usable(position.pose.heading) &&
         std::all_of(all.begin(), all.end(), [](double number) { return is_usable(number); }) &&
         std::min({all[0], all[4], all[8]}) >= number_least && is_covariance(0, 1) && is_covariance(0, 2) &&
         is_covariance(1, 2);
}

}  // namespace

WorldNode::WorldNode(const scenario::Scenario& scenario, std::unique_ptr<WorldTopics> topics,
                     std::vector<NodeCommand> commands, NodeRunOptions options)
    : scenario_(scenario),
      topics_(std::move(topics)),
      air_(scenario, robots_with_nodes(scenario)),
      shown_(std::move(options.shown)),
      is_brief_(options.is_brief),
      processes_(std::move(commands), topics_->nodes(), options.is_brief ? NodeEnds::killed : NodeEnds::asked,
                 std::move(options.environment)),
      expectations_(scenario.expect) {
  for (const std::size_t index : robots_with_nodes(scenario)) robots_.push_back({.index = index});
}

void WorldNode::begin(outside::Host& host) {
  for (std::size_t i = 0; i < robots_.size(); ++i)
    topics_->robot(i).begin(host.experiment().robots()[robots_[i].index]->names());
  publish(host);
}

void WorldNode::publish(outside::Host& host) {
  const world::World& world = host.experiment().world();
  if (published_ == world.steps()) return;
  published_ = world.steps();
  air_.move(world);
  topics_->publish(world, Time() + scenario_.step * static_cast<std::int64_t>(world.steps()));
}

void WorldNode::take_in(outside::Host& host) {
  for (const std::string& error : topics_->take_in(shown_.get()))
    if (faults_.add("damaged messages")) host.tell_fault("nodes", error);
  const bool is_new_second = host.next_step() >= second_ + Duration(std::chrono::seconds(1));
  if (is_new_second) second_ = host.next_step();
  processes_.go_on(host.next_step());
  tell_news(host);
  expectations_.watch(host, topics_->nodes());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (is_new_second) robots_[i].messages = 0;
    if (const auto command = topics_->robot(i).take_command()) {
      count(host, robots_[i], command->messages);
      drive(host, robots_[i], command->twist);
    }
    if (const auto pose = topics_->robot(i).take_pose()) pass_pose(host, robots_[i], *pose);
    show_goal(host, i);
  }
  if (processes_.is_over() || (is_brief_ && expectations_.is_lost(host, processes_))) host.finish();
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

void WorldNode::drive(outside::Host& host, const Robot& robot, const messages::geometry_msgs::Twist& twist) {
  const std::string& name = scenario_.robots[robot.index].name;
  if (!are_usable(twist)) {
    if (faults_.add("speeds that are no numbers, or too great"))
      host.tell_fault(name,
                      "cmd_vel: expected finite speeds of at most 10000, found others: such messages are not obeyed");
    return;
  }
  ++commands_;
  host.intervene(
      fmt::format("command {} v_m_s={} w_rad_s={} side_m_s={} climb_m_s={}", outside::quoted_word(name),
                  rounded(twist.linear.x), rounded(twist.angular.z), rounded(twist.linear.y), rounded(twist.linear.z)),
      {place, 0});
}

void WorldNode::pass_pose(outside::Host& host, const Robot& robot, const posters::PositionEstimate& pose) {
  const std::string& name = scenario_.robots[robot.index].name;
  if (!is_usable(pose)) {
    if (faults_.add("poses that are no numbers"))
      host.tell_fault(name,
                      "pose: expected finite numbers of at most 10000 and a covariance, found others: such messages "
                      "are not taken");
    return;
  }
  ++poses_;
  std::string text = fmt::format("pose {} date_s={} pose.x={} pose.y={} pose.heading={}", outside::quoted_word(name),
                                 pose.date.since_start().seconds(), rounded(pose.pose.x), rounded(pose.pose.y),
                                 rounded(pose.pose.heading));
  for (std::size_t i = 0; i < pose.covariance.size(); ++i)
    text += fmt::format(" covariance.{}={}", i, rounded(pose.covariance[i]));
  host.intervene(text, {place, 0});
}

// Goals are judged by the truth, not by a node's own opinion.
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
    if (!topics_->robot(number).has_driver()) return;
    send_goal(number, goal, body, now);
    robot.goals_sent = *current + 1;
    robot.sent_at = now;
    ++goals_;
    return;
  }
  const bool is_at_rest = std::fabs(body.velocity.v_m_s) < at_rest_m_s;
  const bool has_arrived = length(goal - body.pose.position()) < arrived_m && is_at_rest;
  if (!is_at_rest || std::fabs(body.velocity.w_rad_s) > no_turn_rad_s) robot.active_at = now;
  // As a person would if nothing happens: a planner that starts can lose a goal, or give it up.
  if (!has_arrived && now - robot.active_at >= repetition) send_goal(number, goal, body, now);
  if (!has_arrived && now - robot.sent_at < patience) return;
  host.intervene("goal " + outside::quoted_word(of.name) + (has_arrived ? " reached" : " given-up"), {place, 0});
}

void WorldNode::send_goal(std::size_t number, const Point& position, const world::BodyState& body, Time now) {
  const Point away = position - body.pose.position();
  topics_->robot(number).send_goal({position.x, position.y, exact::atan2(away.y, away.x)});
  robots_[number].active_at = now;
}

std::vector<std::string> WorldNode::unmet() const { return expectations_.unmet(processes_, topics_->nodes()); }

std::string WorldNode::account() const {
  return "nodes: " + counted(goals_, "goal") + ", " + counted(commands_, "command") +
         (poses_ > 0 ? ", " + counted(poses_, "pose") : "") + air_.losses() + faults_.text();
}

}  // namespace waitpoint::nodes
