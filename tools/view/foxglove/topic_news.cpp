// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/foxglove/topic_news.hpp"

#include "modules/run/ranks/archive.hpp"

namespace waitpoint::tools::view {
namespace {

constexpr std::string_view mark = "topics:";  // other messages are JSON

}  // namespace

std::string packed(const TopicNews& news) {
  run::Packing packing;
  packing(news);
  return std::string(mark) + packing.bytes();
}

bool is_topic_news(std::string_view message) { return message.starts_with(mark); }

TopicNews unpacked(std::string_view message) {
  TopicNews news;
  run::Unpacking unpacking(message.substr(mark.size()));
  unpacking(news);
  return news;
}

}  // namespace waitpoint::tools::view
