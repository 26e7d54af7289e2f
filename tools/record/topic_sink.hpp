// SPDX-License-Identifier: BSD-3-Clause
// Where the messages of topics go that a run publishes for Foxglove: a file, or viewers that are connected.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/time.hpp"

namespace waitpoint::tools {

namespace foxglove {

/// A schema's name and its JSON Schema text.
struct Schema {
  std::string name, text;
};

}  // namespace foxglove

class TopicSink {
 public:
  /// Counts the topics, from 0.
  using Topic = std::uint16_t;

  TopicSink() = default;
  virtual ~TopicSink() = default;
  TopicSink(const TopicSink&) = delete;
  TopicSink& operator=(const TopicSink&) = delete;

  /// Adds a topic with JSON messages of a schema. Schemas of one name have one text.
  virtual Topic add(const foxglove::Schema& schema, const std::string& topic) = 0;
  /// False: the topic's messages of now need not be made.
  virtual bool wants(Topic topic) const = 0;
  /// A message that was received at `time`; times need not ascend.
  virtual void write(Topic topic, Time time, std::string_view message) = 0;
  /// Called last.
  virtual void finish() = 0;
};

}  // namespace waitpoint::tools
