// SPDX-License-Identifier: BSD-3-Clause
// Copies of messages' parts into ROS's structs and those of Cyclone DDS; oracle.py writes those of whole messages.
#pragma once

#include <dds/dds.h>
#include <gtest/gtest.h>
#include <ros/time.h>

#include <boost/array.hpp>
#include <cstring>
#include <deque>
#include <memory>

#include "modules/messages/message.hpp"

namespace waitpoint::oracle {

/// ROS's structs name their allocator's member `rebind`, which std::allocator lost in C++20.
template <class T>
struct RosAllocatorOf : std::allocator<T> {
  RosAllocatorOf() = default;
  template <class U>
  RosAllocatorOf(const RosAllocatorOf<U>&) {}
  template <class U>
  struct rebind {
    using other = RosAllocatorOf<U>;
  };
};
using RosAllocator = RosAllocatorOf<void>;

/// What the structs of C point to.
struct Memory : std::deque<std::unique_ptr<char[]>> {};

template <class Message, class RosMessage, class CMessage, const dds_topic_descriptor_t* c_type>
struct Case {
  using Ours = Message;
  using Ros = RosMessage;
  using C = CMessage;
  static constexpr const dds_topic_descriptor_t* type = c_type;
};

template <messages::Plain From, class To>
requires std::is_arithmetic_v<To>
void copy(Memory&, From from, To& to) { to = static_cast<To>(from); }
template <class Allocator>
void copy(Memory&, const std::string& from, std::basic_string<char, std::char_traits<char>, Allocator>& to) {
  to.assign(from.data(), from.size());
}
inline void copy(Memory& memory, const std::string& from, char*& to) {
  to = memory.emplace_back(new char[from.size() + 1]).get();
  std::memcpy(to, from.c_str(), from.size() + 1);
}
inline void copy(Memory&, const messages::Stamp& from, ros::Time& to) {
  to.sec = from.sec;
  to.nsec = from.nsec;
}
inline void copy(Memory&, const messages::Span& from, ros::Duration& to) {
  to.sec = from.sec;
  to.nsec = from.nsec;
}
template <class From, class To>
requires requires(To& to) { to.nanosec; }
void copy(Memory&, const From& from, To& to) {
  to.sec = static_cast<std::int32_t>(from.sec);
  to.nanosec = static_cast<std::uint32_t>(from.nsec);
}
template <class From, class To, std::size_t size>
void copy(Memory& memory, const std::array<From, size>& from, boost::array<To, size>& to) {
  for (std::size_t i = 0; i < size; ++i) copy(memory, from[i], to[i]);
}
template <class From, class To, std::size_t size>
void copy(Memory& memory, const std::array<From, size>& from, To (&to)[size]) {
  for (std::size_t i = 0; i < size; ++i) copy(memory, from[i], to[i]);
}
template <class From, class To, class Allocator>
void copy(Memory& memory, const std::vector<From>& from, std::vector<To, Allocator>& to) {
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) copy(memory, from[i], to[i]);
}
template <class From, class To>
requires requires(To& to) { to._buffer; }
void copy(Memory& memory, const std::vector<From>& from, To& to) {
  using Element = std::remove_pointer_t<decltype(to._buffer)>;
  static_assert(alignof(Element) <= alignof(std::max_align_t));
  to._length = to._maximum = static_cast<std::uint32_t>(from.size());
  to._release = false;
  to._buffer = reinterpret_cast<Element*>(memory.emplace_back(new char[from.size() * sizeof(Element)]()).get());
  for (std::size_t i = 0; i < from.size(); ++i) copy(memory, from[i], to._buffer[i]);
}

}  // namespace waitpoint::oracle
