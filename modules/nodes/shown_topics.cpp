// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/shown_topics.hpp"

#include <algorithm>

namespace waitpoint::nodes {
namespace {

/// Between two paths of a topic that are drawn: those of a local planner come many times a second.
constexpr Duration between_paths = std::chrono::seconds(5);

}  // namespace

void ShownTopics::add(ShownMessage message) {
  if (is_recorded_) new_.push_back(message);
  const auto last = std::find_if(to_draw_.rbegin(), to_draw_.rend(),
                                 [&](const ShownMessage& other) { return other.topic == message.topic; });
  if (last == to_draw_.rend() ||
      (message.kind == ShownMessage::Kind::path && message.date - last->date >= between_paths))
    to_draw_.push_back(std::move(message));
  else if (message.kind != ShownMessage::Kind::path)
    *last = std::move(message);
}

}  // namespace waitpoint::nodes
