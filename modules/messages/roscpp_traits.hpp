// SPDX-License-Identifier: BSD-3-Clause
// Serialized messages of any type, for the templates of roscpp and rosbag. Only for libraries with ROS's headers.
#pragma once

#include <ros/serialization.h>

#include <cstring>
#include <string>
#include <string_view>

#include "modules/messages/description.hpp"

namespace waitpoint::messages {

/// A message to be written; type and bytes must outlive it.
struct SerializedMessage {
  const Ros1Type* type = nullptr;
  std::string_view bytes;
};

/// A message that was received.
struct ReceivedMessage {
  std::string bytes;
};

}  // namespace waitpoint::messages

namespace ros {
namespace message_traits {

// The type is the message's, or any where there is no message.
template <>
struct MD5Sum<waitpoint::messages::SerializedMessage> {
  static const char* value() { return "*"; }
  static const char* value(const waitpoint::messages::SerializedMessage& message) { return message.type->md5.c_str(); }
};
template <>
struct DataType<waitpoint::messages::SerializedMessage> {
  static const char* value() { return "*"; }
  static const char* value(const waitpoint::messages::SerializedMessage& message) { return message.type->name.c_str(); }
};
template <>
struct Definition<waitpoint::messages::SerializedMessage> {
  static const char* value() { return ""; }
  static const char* value(const waitpoint::messages::SerializedMessage& message) {
    return message.type->definition.c_str();
  }
};
template <>
struct MD5Sum<waitpoint::messages::ReceivedMessage> {
  static const char* value() { return "*"; }
};
template <>
struct DataType<waitpoint::messages::ReceivedMessage> {
  static const char* value() { return "*"; }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<waitpoint::messages::SerializedMessage> {
  template <class Stream>
  static void write(Stream& stream, const waitpoint::messages::SerializedMessage& message) {
    const std::string_view bytes = message.bytes;
    if (!bytes.empty())
      std::memcpy(stream.advance(static_cast<std::uint32_t>(bytes.size())), bytes.data(), bytes.size());
  }
  static std::uint32_t serializedLength(const waitpoint::messages::SerializedMessage& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};
template <>
struct Serializer<waitpoint::messages::ReceivedMessage> {
  template <class Stream>
  static void read(Stream& stream, waitpoint::messages::ReceivedMessage& message) {
    message.bytes.assign(reinterpret_cast<const char*>(stream.getData()), stream.getLength());
  }
};

}  // namespace serialization
}  // namespace ros
