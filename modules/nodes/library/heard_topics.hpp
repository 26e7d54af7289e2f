// SPDX-License-Identifier: BSD-3-Clause
// Topics of other nodes, of any type: subscriptions, and the messages that have come.
#pragma once

#include <ros/ros.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "modules/nodes/bag_side.hpp"

namespace waitpoint::nodes {

class HeardTopics {
 public:
  explicit HeardTopics(ros::NodeHandle& node) : node_(node) {}

  /// Once for each topic; again: nothing.
  void subscribe(const std::string& topic);
  /// Those that came by callbacks since the last call, in their order, without those of the run's own node.
  std::vector<HeardMessage> take() { return std::exchange(messages_, {}); }

 private:
  ros::NodeHandle& node_;
  std::map<std::string, ros::Subscriber> subscribers_;
  std::vector<HeardMessage> messages_;
};

}  // namespace waitpoint::nodes
