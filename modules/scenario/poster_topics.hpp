// SPDX-License-Identifier: BSD-3-Clause
// What modules of a robot and its nodes of ROS have of each other: the table `publish` of a robot's `ros`, of the
// posters that are published as topics, and the rows of the bridge that fill posters from topics; and `show`, what
// nodes publish that pictures and recordings have.
//
//   ros:
//     publish: {pom.position: pom/position, rflex.odometry: rflex/odom}
//     show: {plan: path, particlecloud: cloud, /map_of_gmapping: grid}
//   bridge:
//     - {poster: locate.localisation, device: topic.pose}
#pragma once

#include <string>
#include <vector>

#include "modules/scenario/scenario.hpp"

namespace waitpoint::scenario {

/// The device of a bridge's row whose poster has what nodes publish as `pose`.
inline constexpr std::string_view pose_topic_device = "topic.pose";

struct PosterTopic {
  std::string poster, topic;  ///< the topic as written, relative to the robot's namespace
  Location written;
};

/// BadInput for a topic that is no name of ROS.
std::vector<PosterTopic> poster_topics(const NodesScenario& nodes);

struct ShownTopic {
  enum class Kind : unsigned char { path, cloud, grid };

  std::string topic;  ///< as written
  Kind kind = Kind::path;
};

/// BadInput for a topic that is no name of ROS, and for another kind.
std::vector<ShownTopic> shown_topics(const NodesScenario& nodes);

/// True if a poster of the robot is filled from the topic `pose`.
bool takes_pose(const RobotScenario& robot);

}  // namespace waitpoint::scenario
