// SPDX-License-Identifier: BSD-3-Clause
// The world as a ROS node: sensors of the scenario's robots that have nodes become topics, and their nodes' commands
// becomes interventions, which the run's journal repeats without them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modules/nodes/node_expectations.hpp"
#include "modules/nodes/node_processes.hpp"
#include "modules/nodes/robots_air.hpp"
#include "modules/nodes/shown_topics.hpp"
#include "modules/nodes/world_topics.hpp"
#include "modules/outside/fault_counts.hpp"
#include "modules/outside/partner.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::nodes {

/// Of a run with nodes.
struct NodeRunOptions {
  /// It ends as soon as an expectation of the scenario cannot be met any more, and its nodes are killed at the end.
  bool is_brief = false;
  std::vector<EnvironmentVariable> environment = {};  ///< of all nodes, besides the run's
  std::shared_ptr<ShownTopics> shown = {};            ///< gets the messages that pictures and recordings show
};

class WorldNode final : public outside::Partner {
 public:
  /// `commands` of the nodes of all launches of the scenario's robots, in their order: the executable and its
  /// arguments. The scenario must outlive this.
  WorldNode(const scenario::Scenario& scenario, std::unique_ptr<WorldTopics> topics, std::vector<NodeCommand> commands,
            NodeRunOptions options);

  void begin(outside::Host& host) override;
  void publish(outside::Host& host) override;
  void take_in(outside::Host& host) override;
  std::string account() const override;
  std::vector<std::string> unmet() const override;

 private:
  struct Robot {
    std::size_t index;           // in the scenario
    std::size_t goals_sent = 0;  // so far
    Time sent_at = {};           // the last one
    std::uint32_t messages = 0;  // of cmd_vel, within a second
    Time active_at = {};         // its last message, or when the robot moved since
  };

  void show_goal(outside::Host& host, std::size_t number);
  void count(outside::Host& host, Robot& robot, std::uint32_t messages);
  void pass_pose(outside::Host& host, const Robot& robot, const posters::PositionEstimate& pose);
  void send_goal(std::size_t number, const Point& position, const world::BodyState& body, Time now);
  void drive(outside::Host& host, const Robot& robot, const messages::geometry_msgs::Twist& twist);
  void tell_news(outside::Host& host);

  const scenario::Scenario& scenario_;
  std::vector<Robot> robots_;
  std::unique_ptr<WorldTopics> topics_;
  RobotsAir air_;
  std::shared_ptr<ShownTopics> shown_;
  bool is_brief_;
  NodeProcesses processes_;  // end before the master
  NodeExpectations expectations_;
  std::uint64_t commands_ = 0, goals_ = 0, poses_ = 0;
  Time second_;                             // the virtual second of which messages are counted
  std::optional<std::uint64_t> published_;  // step
  outside::FaultCounts faults_;
};

}  // namespace waitpoint::nodes
