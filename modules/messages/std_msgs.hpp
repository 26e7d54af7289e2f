// SPDX-License-Identifier: BSD-3-Clause
// Messages of ROS's package std_msgs. Metres, radians, seconds.
#pragma once

#include "modules/messages/message.hpp"

namespace waitpoint::messages::std_msgs {

struct Header {
  static constexpr std::string_view type_name = "std_msgs/Header";
  std::uint32_t seq = 0;
  Stamp stamp;
  std::string frame_id;
  static void fields(auto field) {
    field("seq", &Header::seq, ros1_only);
    field("stamp", &Header::stamp);
    field("frame_id", &Header::frame_id);
  }
};

struct ColorRGBA {
  static constexpr std::string_view type_name = "std_msgs/ColorRGBA";
  float r = 0;
  float g = 0;
  float b = 0;
  float a = 0;
  static void fields(auto field) {
    field("r", &ColorRGBA::r);
    field("g", &ColorRGBA::g);
    field("b", &ColorRGBA::b);
    field("a", &ColorRGBA::a);
  }
};

}  // namespace waitpoint::messages::std_msgs
