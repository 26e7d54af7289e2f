// SPDX-License-Identifier: BSD-3-Clause
// A bag of ROS 1 whose messages are published to nodes: a master, and a node that has the bag's topics, with the types,
// definitions and latches of its connections. The contents of messages are not interpreted.
//
// Plain values only: the library has no other parts of this program.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "modules/nodes/master_side.hpp"

namespace waitpoint::nodes {

/// The played part of a bag. Its time begins with its first message.
struct BagChoice {
  std::string file;
  std::vector<std::string> topics;          ///< global names; empty: all
  std::int64_t start_ns = 0;                ///< earlier messages are not played, but the last ones of latched topics
  std::optional<std::int64_t> duration_ns;  ///< from start_ns; none: up to the bag's end
};

struct BagSideSetup {
  BagChoice choice;
  bool has_clock = false;                                          ///< publishes /clock; use_sim_time is set
  bool has_debian_master = false;                                  ///< in place of one inside
  bool hears = false;                                              ///< subscribes to the nodes' topics
  std::vector<std::pair<std::string, nlohmann::json>> parameters;  ///< by global name; no maps
};

struct TopicCount {
  std::string topic;
  std::uint64_t messages = 0;
};

/// A message of a node.
struct HeardMessage {
  std::string topic, type, publisher;  ///< global names
  std::string bytes;                   ///< serialized
};

class BagSide : public MasterSide {
 public:
  /// The time of the next message, from start_ns; none: all were played. Throws std::runtime_error if the bag cannot be
  /// read.
  virtual std::optional<std::int64_t> next_ns() = 0;
  /// Publishes it.
  virtual void play_next() = 0;
  /// Publishes the last messages of latched topics before start_ns.
  virtual void play_latched() = 0;
  /// Publishes /clock, at a time from start_ns.
  virtual void show_clock(std::int64_t time_ns) = 0;
  /// The messages of nodes since the last call, in their order of arrival; subscribes to topics that they have
  /// begun to publish.
  virtual std::vector<HeardMessage> hear() = 0;

  /// So far, by name.
  virtual std::vector<TopicCount> played() const = 0;
};

}  // namespace waitpoint::nodes
