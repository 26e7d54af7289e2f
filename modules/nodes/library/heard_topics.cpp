// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/heard_topics.hpp"

#include <topic_tools/shape_shifter.h>

#include "modules/nodes/library/own_node.hpp"

namespace waitpoint::nodes {
namespace {

using Shape = topic_tools::ShapeShifter;
using Event = ros::MessageEvent<const Shape>;

constexpr std::uint32_t any_number = 0;

std::string bytes_of(const Shape& message) {
  std::string bytes(message.size(), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()), message.size());
  message.write(stream);
  return bytes;
}

}  // namespace

void HeardTopics::subscribe(const std::string& topic) {
  const auto [subscriber, is_new] = subscribers_.try_emplace(topic);
  if (!is_new) return;
  const boost::function<void(const Event&)> take = [this, topic](const Event& event) {
    const std::string& publisher = event.getPublisherName();
    if (publisher == own_name) return;
    const Shape& message = *event.getConstMessage();
    messages_.push_back({topic, message.getDataType(), publisher, bytes_of(message)});
  };
  subscriber->second = node_.subscribe<const Event&>(topic, any_number, take);
}

}  // namespace waitpoint::nodes
