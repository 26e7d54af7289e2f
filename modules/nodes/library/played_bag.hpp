// SPDX-License-Identifier: BSD-3-Clause
// The messages of a bag that are to be played, in the order of their times.
#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <memory>
#include <string>
#include <vector>

#include "modules/nodes/bag_side.hpp"

namespace waitpoint::nodes {

/// "/scan", also for a bag that has it as "scan".
std::string topic_of(const std::string& written);

class PlayedBag {
 public:
  /// Throws std::runtime_error, a line without the bag's name: for a file that is no bag, is damaged or without an
  /// index, for a topic that it does not have or has with two types, and if there is no message.
  explicit PlayedBag(const BagChoice& choice);

  /// Decompresses and reads every message that is to be played. Throws as above.
  void read_through();

  /// The next message; nullptr after the last one. It lives until the next call of advance(). Throws as above.
  const rosbag::MessageInstance* next();
  /// From the beginning of the played part.
  std::int64_t time_ns(const rosbag::MessageInstance& message) const;
  void advance() { ++at_; }

  /// Of each connection that latches, the last message before the beginning of the played part.
  std::vector<rosbag::MessageInstance> latched_before();
  /// Those of the topics, of any time.
  const std::vector<const rosbag::ConnectionInfo*>& connections() const { return connections_; }

 private:
  void open(const std::string& file);
  std::vector<std::string> written_topics(const std::vector<std::string>& wanted);
  void check_types() const;

  rosbag::Bag bag_;
  std::vector<std::string> topics_;  // as the bag writes them
  std::vector<const rosbag::ConnectionInfo*> connections_;
  ros::Time bag_begin_, begin_;
  std::unique_ptr<rosbag::View> view_;
  rosbag::View::iterator at_;
};

}  // namespace waitpoint::nodes
