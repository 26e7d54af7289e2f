// SPDX-License-Identifier: BSD-3-Clause
// A message of a recording, in any of the encodings in which recordings have messages.
#pragma once

#include <string>
#include <string_view>

#include "core/time.hpp"
#include "modules/messages/json.hpp"
#include "modules/messages/wire.hpp"

namespace waitpoint::logs {

enum class Encoding : unsigned char { ros1, cdr, json };

struct RecordedMessage {
  Time received;  ///< the recorder's clock, which orders the messages of a recording
  std::string topic;
  std::string type;  ///< "sensor_msgs/LaserScan", in ROS 2 "sensor_msgs/msg/LaserScan"
  Encoding encoding = Encoding::ros1;
  std::string_view bytes;

  template <messages::Message M>
  bool is() const {
    const std::size_t infix = type.find("/msg/");
    constexpr std::size_t infix_size = 4;
    return infix == type.npos ? type == M::type_name
                              : type.substr(0, infix) + type.substr(infix + infix_size) == M::type_name;
  }
  /// BadInput, naming the message's `place`, for one that is cut off or malformed.
  template <messages::Message M>
  M read(const std::string& place) const {
    switch (encoding) {
      case Encoding::ros1: return messages::decode<M, messages::Wire::ros1>(place, bytes);
      case Encoding::cdr: return messages::decode<M, messages::Wire::cdr>(place, bytes);
      case Encoding::json: break;
    }
    return messages::decode_json<M>(place, bytes);
  }
};

}  // namespace waitpoint::logs
