// SPDX-License-Identifier: BSD-3-Clause
// Messages of ROS's package tf2_msgs. Metres, radians, seconds.
#pragma once

#include "modules/messages/geometry_msgs.hpp"
#include "modules/messages/message.hpp"

namespace waitpoint::messages::tf2_msgs {

struct TFMessage {
  static constexpr std::string_view type_name = "tf2_msgs/TFMessage";
  std::vector<geometry_msgs::TransformStamped> transforms;
  static void fields(auto field) { field("transforms", &TFMessage::transforms); }
};

}  // namespace waitpoint::messages::tf2_msgs
