// SPDX-License-Identifier: BSD-3-Clause
// Messages of ROS's package rosgraph_msgs. Metres, radians, seconds.
#pragma once

#include "modules/messages/message.hpp"
#include "modules/messages/std_msgs.hpp"

namespace waitpoint::messages::rosgraph_msgs {

struct Clock {
  static constexpr std::string_view type_name = "rosgraph_msgs/Clock";
  Stamp clock;
  static void fields(auto field) { field("clock", &Clock::clock); }
};

struct Log {
  static constexpr std::string_view type_name = "rosgraph_msgs/Log";
  static constexpr Constant<Byte> constants[] = {
      {"DEBUG", Byte{1}}, {"INFO", Byte{2}}, {"WARN", Byte{4}}, {"ERROR", Byte{8}}, {"FATAL", Byte{16}}};
  std_msgs::Header header;
  Byte level{};
  std::string name;
  std::string msg;
  std::string file;
  std::string function;
  std::uint32_t line = 0;
  std::vector<std::string> topics;
  static void fields(auto field) {
    field("header", &Log::header);
    field("level", &Log::level);
    field("name", &Log::name);
    field("msg", &Log::msg);
    field("file", &Log::file);
    field("function", &Log::function);
    field("line", &Log::line);
    field("topics", &Log::topics);
  }
};

}  // namespace waitpoint::messages::rosgraph_msgs
