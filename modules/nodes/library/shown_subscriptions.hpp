// SPDX-License-Identifier: BSD-3-Clause
// The topics of nodes that pictures and recordings show, of one robot.
#pragma once

#include <ros/ros.h>

#include <vector>

#include "modules/nodes/node_side.hpp"

namespace waitpoint::nodes {

class ShownSubscriptions {
 public:
  explicit ShownSubscriptions(const RobotTopics& topics);

  /// What has come since the last call, in its order; dates are since `begin`.
  std::vector<ShownReading> take(const ros::Time& begin);

 private:
  struct Received {
    ros::Time stamp;
    ShownReading reading;
  };
  template <class Message>
  void subscribe(const ShownTopic& shown);

  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<Received> received_;
};

}  // namespace waitpoint::nodes
