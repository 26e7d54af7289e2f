// SPDX-License-Identifier: BSD-3-Clause
// Numbers in messages of nodes, compared with the scenario's expectations.
#pragma once

#include <ros/node_handle.h>
#include <topic_tools/shape_shifter.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modules/nodes/library/message_layout.hpp"
#include "modules/nodes/node_side.hpp"

namespace waitpoint::nodes {

class TopicWatch {
 public:
  /// Subscribes to the topics. They are called by the queue of `node`.
  TopicWatch(ros::NodeHandle& node, const std::vector<TopicBound>& bounds);

  /// Since the last call, the first message of each bound that is not as expected, in words.
  std::vector<std::string> take_breaches();
  /// The topics of which no message has come.
  std::vector<std::string> unheard() const;

 private:
  struct Watched {
    TopicBound bound;
    ros::Subscriber subscriber = {};
    std::string type = {};
    std::optional<MessageLayout> layout = {};
    bool is_broken = false;
  };
  void take(Watched& watched, const topic_tools::ShapeShifter& message);
  void note(Watched& watched, const std::string& found);

  std::vector<std::unique_ptr<Watched>> all_;
  std::vector<std::string> breaches_;
};

}  // namespace waitpoint::nodes
