// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/world_topics.hpp"

#include "modules/ros1/launch.hpp"
#include "modules/scenario/poster_topics.hpp"

namespace waitpoint::nodes {
namespace {

std::vector<LaserTopic> lasers_of(const scenario::RobotScenario& robot, const std::string& prefix) {
  std::vector<LaserTopic> topics;
  topics.reserve(robot.body.lasers.size());
  for (std::size_t i = 0; i < robot.body.lasers.size(); ++i) {
    const world::LaserDescription& laser = robot.body.lasers[i];
    const std::string& name = robot.laser_names[i];
    topics.push_back({.topic = robot.body.lasers.size() == 1 ? "scan" : name,
                      .frame = prefix + name,
                      .mount = place_of(laser.mount, laser.height_m),
                      .range_max = laser.range_max_m,
                      .period_s = laser.period.seconds()});
  }
  return topics;
}

std::vector<SonarTopic> sonars_of(const scenario::RobotScenario& robot, const std::string& prefix) {
  std::vector<SonarTopic> topics;
  topics.reserve(robot.body.sonars.size());
  for (std::size_t ring = 0; ring < robot.body.sonars.size(); ++ring) {
    const world::SonarRingDescription& sonars = robot.body.sonars[ring];
    const std::string name = ring == 0 ? "sonar" : "sonar_" + std::to_string(ring);
    SonarTopic topic{.topic = name,
                     .frames = {},
                     .mounts = {},
                     .field_of_view = 2 * sonars.half_cone_rad,
                     .range_min = sonars.range_min_m,
                     .range_max = sonars.range_max_m};
    for (std::uint32_t i = 0; i < sonars.count; ++i) {
      const double heading = exact::wrap_angle(2 * exact::pi * i / sonars.count);
      topic.frames.push_back(prefix + name + "_" + std::to_string(i));
      topic.mounts.push_back({sonars.ring_radius_m * exact::cos(heading), sonars.ring_radius_m * exact::sin(heading),
                              heading, sonars.height_m});
    }
    topics.push_back(std::move(topic));
  }
  return topics;
}

GridValues values_of(const OccupancyGrid& map) {
  constexpr std::int8_t free = 0, occupied = 100, unknown = -1;
  GridValues values{.width = map.width(),
                    .height = map.height(),
                    .resolution = map.resolution_m(),
                    .origin = place_of(map.origin()),
                    .cells = {}};
  values.cells.reserve(map.cells().size());
  for (const Cell cell : map.cells())
    values.cells.push_back(cell == Cell::free ? free : cell == Cell::occupied ? occupied : unknown);
  return values;
}

std::vector<ShownTopic> topics_shown(const scenario::NodesScenario& nodes) {
  std::vector<ShownTopic> topics;
  for (scenario::ShownTopic& row : scenario::shown_topics(nodes))
    topics.push_back({std::move(row.topic), static_cast<ShownTopic::Kind>(row.kind)});
  return topics;
}

std::vector<std::string> topics_of_posters(const scenario::NodesScenario& nodes) {
  std::vector<std::string> topics;
  for (scenario::PosterTopic& row : scenario::poster_topics(nodes)) topics.push_back(std::move(row.topic));
  return topics;
}

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

Place place_of(const Pose& pose, double z) { return {pose.x, pose.y, pose.heading, z}; }

std::vector<std::size_t> robots_with_nodes(const scenario::Scenario& scenario) {
  std::vector<std::size_t> robots;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i)
    if (scenario.robots[i].nodes) robots.push_back(i);
  return robots;
}

NodeSideSetup node_side_setup(const scenario::Scenario& scenario, const OccupancyGrid& map) {
  NodeSideSetup setup{.has_clock = scenario.ros.publishes_clock,
                      .has_debian_master = scenario.ros.master == scenario::RosScenario::Master::outside,
                      .robots = {},
                      .map = values_of(map),
                      .parameters = {},
                      .bounds = bounds_of(scenario.expect)};
  for (const std::size_t i : robots_with_nodes(scenario)) {
    const scenario::RobotScenario& robot = scenario.robots[i];
    const scenario::NodesScenario& nodes = *robot.nodes;
    const std::string prefix = nodes.tf_prefix.empty() ? "" : nodes.tf_prefix + "/";
    setup.robots.push_back({.space = nodes.ns,
                            .prefix = prefix,
                            .start = place_of(robot.body.start),
                            .lasers = lasers_of(robot, prefix),
                            .sonars = sonars_of(robot, prefix),
                            .has_imu = robot.body.imu.has_value(),
                            .posters = topics_of_posters(nodes),
                            .shown = topics_shown(nodes),
                            .takes_pose = scenario::takes_pose(robot),
                            .gives_map_to_odom = nodes.gives_map_to_odom});
    for (const auto& [name, parameter] : nodes.launch->parameters) setup.parameters.emplace_back(name, parameter.value);
  }
  return setup;
}

}  // namespace waitpoint::nodes
