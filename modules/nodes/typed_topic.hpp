// SPDX-License-Identifier: BSD-3-Clause
// A topic of the world's node, with messages of one declared type.
#pragma once

#include "modules/messages/wire.hpp"
#include "modules/nodes/node_side.hpp"

namespace waitpoint::nodes {

/// Its last message reaches later subscribers.
inline constexpr bool latched = true;

template <messages::Message M>
class TypedTopic {
 public:
  /// `nodes` must outlive this.
  TypedTopic(NodeSide& nodes, const std::string& name, std::uint32_t queue, bool is_latched = false)
      : nodes_(&nodes), topic_(nodes.advertise(name, messages::ros1_type<M>(), queue, is_latched)) {}

  void publish(const M& message) const { nodes_->publish(topic_, messages::encode<messages::Wire::ros1>(message)); }
  bool has_subscribers() const { return nodes_->has_subscribers(topic_); }

 private:
  NodeSide* nodes_;
  NodeSide::Topic topic_;
};

}  // namespace waitpoint::nodes
