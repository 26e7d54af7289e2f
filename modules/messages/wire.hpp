// SPDX-License-Identifier: BSD-3-Clause
// Messages as bytes, little-endian, by the tables of their fields.
//
//   ROS 1   no padding; lengths of 32 bits before texts and lists (wiki.ros.org/msg)
//   CDR     the format of ROS 2, XCDR version 1 (OMG DDS-XTypes 1.3, 7.4.1): a head of four bytes; every number at a
//           multiple of its size behind the head; texts end with a NUL, which their length counts
//
// decode() throws BadInput, naming the message's `place`, for one that is cut off or is big-endian. Bytes behind the
// message are ignored: they may be fields of a later version of its type.
#pragma once

#include <cstring>
#include <span>
#include <string>

#include "modules/messages/byte_reader.hpp"
#include "modules/messages/message.hpp"

namespace waitpoint::messages {

enum class Wire : bool { ros1, cdr };

inline constexpr std::string_view cdr_head{"\0\1\0\0", 4};  // little-endian, no options

template <Wire wire>
class WireWriter {
 public:
  template <class T>
  void put(const T& value) {
    if constexpr (Plain<T>) {
      align(sizeof value);
      copy(std::span(&value, 1));
    } else if constexpr (std::same_as<T, std::string>) {
      constexpr std::size_t end = wire == Wire::cdr ? 1 : 0;
      put(length(value.size() + end));
      bytes_.append(value).append(end, '\0');
    } else if constexpr (HasFields<T>) {
      T::fields([&](std::string_view, auto member, auto... facts) {
        if constexpr (wire == Wire::ros1 || !has_fact<Ros1Only, decltype(facts)...>) put(value.*member);
      });
    } else {
      if constexpr (is_list<T>) put(length(value.size()));
      put_elements(value);
    }
  }
  std::string take() { return std::move(bytes_); }
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }

 private:
  static std::uint32_t length(std::size_t size) {
    WAITPOINT_CHECK(size <= UINT32_MAX, "a part of a message has more elements than its length holds");
    return static_cast<std::uint32_t>(size);
  }
  template <class List>
  void put_elements(const List& values) {
    using Element = typename List::value_type;
    if constexpr (Plain<Element>) {
      if (values.empty()) return;
      align(sizeof(Element));
      copy(std::span(values));
    } else {
      for (const Element& value : values) put(value);
    }
  }
  template <class T, std::size_t N>
  void copy(std::span<const T, N> values) {
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  void align(std::size_t size) {
    if constexpr (wire == Wire::cdr) bytes_.append((size - bytes_.size() % size) % size, '\0');
  }

  std::string bytes_;  // without CDR's head
};

template <Wire wire>
class WireReader {
 public:
  /// `place` must outlive the reader.
  WireReader(const std::string& place, std::string_view bytes) : bytes_(place, behind_head(place, bytes)) {}

  template <class T>
  void take(T& value) {
    if constexpr (std::same_as<T, bool>) {
      value = bytes_.number<std::uint8_t>() != 0;
    } else if constexpr (Plain<T>) {
      align(sizeof value);
      copy(std::span(&value, 1));
    } else if constexpr (std::same_as<T, std::string>) {
      value = bytes_.take(count(1));
      if (wire == Wire::cdr && value.ends_with('\0')) value.pop_back();
    } else if constexpr (HasFields<T>) {
      T::fields([&](std::string_view, auto member, auto... facts) {
        if constexpr (wire == Wire::ros1 || !has_fact<Ros1Only, decltype(facts)...>) take(value.*member);
      });
    } else {
      if constexpr (is_list<T>) value.resize(count(least_size<typename T::value_type>()));
      take_elements(value);
    }
  }

 private:
  static std::string_view behind_head(const std::string& place, std::string_view bytes) {
    if (wire == Wire::ros1) return bytes;
    // The third and fourth byte are options.
    if (!bytes.starts_with(cdr_head.substr(0, 2)) || bytes.size() < cdr_head.size())
      throw BadInput(place, "expected messages in little-endian CDR");
    return bytes.substr(cdr_head.size());
  }
  /// The least number of bytes of a value: a length that does not fit into the rest is refused before memory is taken.
  template <class T>
  static std::size_t least_size() {
    if constexpr (Plain<T>) return sizeof(T);
    if constexpr (array_size < T >> 0) return array_size<T> * least_size<typename T::value_type>();
    if constexpr (!HasFields<T>) return sizeof(std::uint32_t);
    std::size_t size = 0;
    if constexpr (HasFields<T>)
      T::fields([&]<class Member>(std::string_view, Member T::*, auto... facts) {
        if (wire == Wire::ros1 || !has_fact<Ros1Only, decltype(facts)...>) size += least_size<Member>();
      });
    return size;
  }
  std::uint32_t count(std::size_t element_bytes) {
    std::uint32_t count = 0;
    take(count);
    if (count > bytes_.left() / element_bytes) bytes_.reject("more bytes, found the end of a record");
    return count;
  }
  template <class List>
  void take_elements(List& values) {
    using Element = typename List::value_type;
    if constexpr (Plain<Element> && !std::same_as<Element, bool>) {
      if (values.empty()) return;
      align(sizeof(Element));
      copy(std::span(values));
    } else {
      for (Element& value : values) take(value);
    }
  }
  template <class T, std::size_t N>
  void copy(std::span<T, N> values) {
    std::memcpy(values.data(), bytes_.take(values.size_bytes()).data(), values.size_bytes());
  }
  void align(std::size_t size) {
    if constexpr (wire == Wire::cdr) bytes_.align(size);
  }

  ByteReader bytes_;
};

template <Wire wire, HasFields M>
std::string encode(const M& message) {
  WireWriter<wire> writer;
  writer.put(message);
  return wire == Wire::cdr ? std::string(cdr_head) + writer.take() : writer.take();
}

template <HasFields M, Wire wire>
M decode(const std::string& place, std::string_view bytes) {
  M message;
  WireReader<wire>(place, bytes).take(message);
  return message;
}

}  // namespace waitpoint::messages
