// SPDX-License-Identifier: BSD-3-Clause
// The topics of one robot with nodes, in its namespace. Names and frames are those of REP 103 and 105: x ahead, y to
// the left, angles counter-clockwise; map -> odom -> base_link. Metres, radians, seconds.
//
//   published   its sensors (sensor_topics.hpp), odom, base_pose_ground_truth, move_base_simple/goal, initialpose;
//               posters of its modules (poster_topics.hpp)
//   taken       cmd_vel; pose, if a poster is filled from it; topics that are shown (shown_topics.hpp)
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "modules/messages/geometry_msgs.hpp"
#include "modules/messages/nav_msgs.hpp"
#include "modules/messages/tf2_msgs.hpp"
#include "modules/nodes/poster_topics.hpp"
#include "modules/nodes/sensor_topics.hpp"
#include "modules/nodes/shown_topics.hpp"
#include "modules/nodes/typed_topic.hpp"
#include "modules/rflex/dead_reckoning.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/world.hpp"

namespace waitpoint::nodes {

class RobotTopics {
 public:
  /// The nodes' command by cmd_vel.
  struct Command {
    messages::geometry_msgs::Twist twist;  ///< of the newest message
    std::uint32_t messages = 0;            ///< those that came, as far as the queue has kept them
  };

  /// Advertises and subscribes. Both must outlive this.
  RobotTopics(NodeSide& nodes, const scenario::Scenario& scenario, std::size_t robot);

  /// From now on its modules have posters.
  void begin(const genom::NameSpace& names);
  /// After a step of the world; transforms are added to `tf`.
  void publish(const world::World& world, Time now, messages::tf2_msgs::TFMessage& tf);
  /// The transforms to its sensors.
  void add_fixed(messages::tf2_msgs::TFMessage& tf) const;
  /// Its start, for nodes that localise it.
  void send_start() const;
  /// A goal in the map, of the last step.
  void send_goal(const Pose& goal) const;
  /// True if a node takes its goals.
  bool has_driver() const { return goal_.has_subscribers(); }

  /// Takes a message of one of its subscriptions; false for others. BadInput for one that is cut off.
  bool take(const NodeSide::Received& received, ShownTopics* shown);
  std::optional<Command> take_command() { return std::exchange(command_, std::nullopt); }
  /// The newest message of `pose` since the last call; its date is virtual.
  std::optional<posters::PositionEstimate> take_pose() { return std::exchange(pose_, std::nullopt); }

 private:
  struct Shown {
    NodeSide::Subscription subscription;
    std::string topic;
    ShownMessage::Kind kind;
  };

  std::string global(const std::string& topic) const;
  messages::Stamp stamp(Time date) const { return messages::stamp_of(begin_ + date.since_start()); }
  void publish_odometry(const world::World& world, messages::tf2_msgs::TFMessage& tf);

  NodeSide& nodes_;
  const scenario::Scenario& scenario_;
  const scenario::RobotScenario& robot_;
  world::BodyId id_;
  std::string space_, prefix_, base_, odom_;  // namespace of its topics; prefix of its frames; frames
  Time begin_;                                // of the run, for nodes
  Time now_;                                  // of the last step
  rflex::DeadReckoning dead_reckoning_;
  SensorTopics sensors_;
  TypedTopic<messages::nav_msgs::Odometry> odometry_, truth_;
  TypedTopic<messages::geometry_msgs::PoseStamped> goal_;
  TypedTopic<messages::geometry_msgs::PoseWithCovarianceStamped> start_;
  std::optional<PosterTopics> posters_;  // from the run's begin on
  std::optional<NodeSide::Subscription> pose_subscription_;
  NodeSide::Subscription command_subscription_ = 0;
  std::vector<Shown> shown_;
  std::optional<Command> command_;
  std::optional<posters::PositionEstimate> pose_;
};

}  // namespace waitpoint::nodes
