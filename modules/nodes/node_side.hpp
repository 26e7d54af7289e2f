// SPDX-License-Identifier: BSD-3-Clause
// The side of a run that ROS nodes see: a master, and a node that is the world. It is in a library of its own, which is
// loaded by the first scenario with nodes, so that other programs do not need ROS. Topics carry messages in ROS 1's
// wire format (modules/messages); the library does not interpret them.
//
//   world -> WorldNode (world_node.hpp) -> NodeSide -> topics -> nodes
//   nodes -> topics -> NodeSide -> WorldNode -> interventions -> world
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "modules/messages/description.hpp"
#include "modules/nodes/bag_side.hpp"
#include "modules/nodes/master_side.hpp"

namespace waitpoint::nodes {

/// The expectation of each message of a topic.
struct TopicBound {
  enum class Relation : unsigned char { at_least, at_most, equal };

  std::string topic, field;  ///< "/odom", "pose.pose.position.x"
  Relation relation = Relation::equal;
  double limit = 0;
  std::string text;  ///< as written: "/odom.pose.pose.position.x<=10"
};

struct NodeSideSetup {
  bool has_clock = false;                                          ///< publishes /clock; use_sim_time is set
  bool has_debian_master = false;                                  ///< in place of one inside
  std::vector<std::pair<std::string, nlohmann::json>> parameters;  ///< by global name; maps only within lists
};

class NodeSide : public MasterSide {
 public:
  using Topic = std::size_t;
  using Subscription = std::size_t;
  /// A message that a node has published.
  struct Received {
    Subscription subscription = 0;
    std::string bytes;
  };

  /// The nodes' time at the beginning of the run.
  virtual Time begin() const = 0;

  /// Names are global; the type must outlive this. `queue`: the number of messages that wait for a slow subscriber.
  virtual Topic advertise(const std::string& name, const messages::Ros1Type& type, std::uint32_t queue,
                          bool is_latched) = 0;
  virtual void publish(Topic topic, std::string_view bytes) = 0;
  virtual bool has_subscribers(Topic topic) const = 0;
  virtual Subscription subscribe(const std::string& name, const messages::Ros1Type& type, std::uint32_t queue) = 0;
  /// The messages since the last call, in their order.
  virtual std::vector<Received> take_received() = 0;
  /// A service with an empty request and a constant response; `type` is the response's.
  virtual void serve(const std::string& name, const std::string& service_type, const messages::Ros1Type& type,
                     std::string response) = 0;

  /// Subscribes to the topics of the bounds.
  virtual void watch(const std::vector<TopicBound>& bounds) = 0;
  /// Since the last call, of each bound the first message that is not as expected, in words.
  virtual std::vector<std::string> take_breaches() = 0;
  /// The topics with bounds of which no message has come.
  virtual std::vector<std::string> unheard_topics() const = 0;
};

/// The library's functions.
struct Library {
  static constexpr const char* file = "libwaitpoint-nodes.so";
  static constexpr const char* symbol = "waitpoint_nodes_2";  ///< with the version of this file

  /// Starts the master. Throws std::runtime_error.
  std::unique_ptr<NodeSide> (*make)(const NodeSideSetup& setup);
  /// Reads the bag from its beginning to its end. Throws std::runtime_error, a line, if it cannot be played.
  void (*check_bag)(const BagChoice& choice);
  /// Starts the master, and advertises the topics. Throws std::runtime_error.
  std::unique_ptr<BagSide> (*make_bag_side)(const BagSideSetup& setup);
};

}  // namespace waitpoint::nodes
