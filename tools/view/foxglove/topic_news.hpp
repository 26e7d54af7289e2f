// SPDX-License-Identifier: BSD-3-Clause
// What a run tells its viewer of the topics that it publishes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"
#include "tools/record/topic_sink.hpp"

namespace waitpoint::tools::view {

struct TopicNews {
  using Topic = TopicSink::Topic;

  enum class Kind : std::uint8_t {
    steps,    ///< messages of steps of the world, of wanted topics
    current,  ///< what there is of the topics of `asked`, for those who have just subscribed
    last,     ///< what there is of all topics: the run is over
  };
  struct Announced {
    std::string name;
    foxglove::Schema schema;
    friend void carry(auto& archive, Announced& topic) { archive(topic.name, topic.schema.name, topic.schema.text); }
  };
  struct Message {
    Topic topic = 0;
    Time time;
    std::string text;
    friend void carry(auto& archive, Message& message) { archive(message.topic, message.time, message.text); }
  };

  Kind kind = Kind::steps;
  std::vector<Announced> added{};  ///< topics, numbered from the last one of before
  std::vector<Topic> asked{};
  std::vector<Message> messages{};
  std::string trouble{};  ///< why there will be no more

  friend void carry(auto& archive, TopicNews& news) {
    archive(news.kind, news.added, news.asked, news.messages, news.trouble);
  }
};

/// As a message of a channel, which differs from all others there.
std::string packed(const TopicNews& news);
bool is_topic_news(std::string_view message);
TopicNews unpacked(std::string_view message);

}  // namespace waitpoint::tools::view
