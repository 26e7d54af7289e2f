// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/world_topics.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "modules/messages/nav_msgs.hpp"
#include "modules/messages/readings.hpp"
#include "modules/messages/rosgraph_msgs.hpp"
#include "modules/nodes/typed_topic.hpp"
#include "modules/ros1/launch.hpp"

namespace waitpoint::nodes {
namespace {

constexpr std::uint32_t world_queue = 100;

std::vector<TopicBound> bounds_of(const scenario::Expectation& expect) {
  std::vector<TopicBound> bounds;
  bounds.reserve(expect.topics.size());
  for (const scenario::TopicExpectation& topic : expect.topics) {
    constexpr TopicBound::Relation relations[] = {TopicBound::Relation::at_least, TopicBound::Relation::at_most,
                                                  TopicBound::Relation::equal};
    bounds.push_back({topic.topic, topic.field, relations[static_cast<int>(topic.relation)], topic.limit, topic.text});
  }
  return bounds;
}

}  // namespace

std::vector<std::size_t> robots_with_nodes(const scenario::Scenario& scenario) {
  std::vector<std::size_t> robots;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i)
    if (scenario.robots[i].nodes) robots.push_back(i);
  return robots;
}

NodeSideSetup node_side_setup(const scenario::Scenario& scenario) {
  NodeSideSetup setup{.has_clock = scenario.ros.publishes_clock,
                      .has_debian_master = scenario.ros.master == scenario::RosScenario::Master::outside,
                      .parameters = {}};
  for (const std::size_t i : robots_with_nodes(scenario))
    for (const auto& [name, parameter] : scenario.robots[i].nodes->launch->parameters)
      setup.parameters.emplace_back(name, parameter.value);
  return setup;
}

WorldTopics::WorldTopics(const scenario::Scenario& scenario, const OccupancyGrid& map, std::unique_ptr<NodeSide> nodes)
    : nodes_(std::move(nodes)), begin_(nodes_->begin()) {
  using messages::Wire;
  if (scenario.ros.publishes_clock) clock_.emplace(*nodes_, "/clock", world_queue);
  tf_.emplace(*nodes_, "/tf", world_queue);
  const TypedTopic<messages::tf2_msgs::TFMessage> fixed(*nodes_, "/tf_static", world_queue, latched);
  const TypedTopic<messages::nav_msgs::OccupancyGrid> map_topic(*nodes_, "/map", 1, latched);
  const messages::nav_msgs::OccupancyGrid known = messages::message_of(map, begin_, "map");
  map_topic.publish(known);
  using Response = messages::nav_msgs::GetMapResponse;
  nodes_->serve("/static_map", "nav_msgs/GetMap", messages::ros1_type<Response>(),
                messages::encode<Wire::ros1>(Response{known}));
  messages::tf2_msgs::TFMessage to_sensors;
  for (const std::size_t robot : robots_with_nodes(scenario)) {
    robots_.push_back(std::make_unique<RobotTopics>(*nodes_, scenario, robot));
    robots_.back()->add_fixed(to_sensors);
    robots_.back()->send_start();
  }
  fixed.publish(to_sensors);
  nodes_->watch(bounds_of(scenario.expect));
}

void WorldTopics::publish(const world::World& world, Time now) {
  if (clock_) clock_->publish({messages::stamp_of(begin_ + now.since_start())});
  messages::tf2_msgs::TFMessage tf;
  for (const auto& robot : robots_) robot->publish(world, now, tf);
  if (!tf.transforms.empty()) tf_->publish(tf);
}

std::vector<std::string> WorldTopics::take_in(ShownTopics* shown) {
  std::vector<std::string> damaged;
  for (const NodeSide::Received& received : nodes_->take_received()) {
    try {
      (void)std::any_of(robots_.begin(), robots_.end(),
                        [&](const auto& robot) { return robot->take(received, shown); });
    } catch (const BadInput& error) {
      damaged.emplace_back(error.what());
    }
  }
  return damaged;
}

}  // namespace waitpoint::nodes
