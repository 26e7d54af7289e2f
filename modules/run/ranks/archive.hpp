// SPDX-License-Identifier: BSD-3-Clause
// Values as bytes, between the processes of one run, which are of one build: a type lists its members once, unless it
// has declared fields (core/fields.hpp).
//
//   void carry(auto& archive, RobotResult& result) { archive(result.name, result.goals, result.distance_m); }
//
//   Packing packing;                       Unpacking unpacking(bytes);
//   packing(result);                       unpacking(result);
//   send(packing.bytes());
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "core/fields.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace waitpoint::run {

/// Copied byte by byte: without padding and pointers.
template <class T>
concept Plain =
    std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Time> || std::is_same_v<T, Duration> ||
    std::is_same_v<T, Point> || std::is_same_v<T, Pose> || std::is_same_v<T, Digest> || std::is_same_v<T, PairDigest>;

class Packing {
 public:
  static constexpr bool is_reading = false;

  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  std::string& bytes() { return bytes_; }

 private:
  template <Plain T>
  void put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put(const std::string& text) {
    put(text.size());
    bytes_ += text;
  }
  template <class T>
  void put(const std::vector<T>& items) {
    put(items.size());
    for (const T& item : items) put(item);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class T, std::size_t Size>
  void put(const std::array<T, Size>& items) {
    for (const T& item : items) put(item);
  }
  template <class T, std::size_t Capacity>
  void put(const Bounded<T, Capacity>& items) {
    put(items.size());
    for (const T& item : items) put(item);
  }
  template <HasFields T>
  void put(const T& value) {
    for_each_field(value, [this](std::string_view, const auto& member) { put(member); });
  }
  template <class T>
  requires(!Plain<T> && !HasFields<T>) void put(const T& value) {
    carry(*this, const_cast<T&>(value));  // which it only reads
  }

  std::string bytes_;
};

class Unpacking {
 public:
  static constexpr bool is_reading = true;

  explicit Unpacking(std::string_view bytes) : rest_(bytes) {}

  template <class... T>
  void operator()(T&... values) {
    (take(values), ...);
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view next(std::size_t count) {
    WAITPOINT_CHECK(count <= rest_.size(), "bytes of another rank end too early");
    const std::string_view part = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return part;
  }
  template <Plain T>
  void take(T& value) {
    std::memcpy(static_cast<void*>(&value), next(sizeof value).data(), sizeof value);
  }
  void take(std::string& text) {
    std::size_t size = 0;
    take(size);
    text = next(size);
  }
  template <class T>
  void take(std::vector<T>& items) {
    std::size_t size = 0;
    take(size);
    items.clear();
    for (std::size_t i = 0; i < size; ++i) take(items.emplace_back());
  }
  template <class T>
  void take(std::optional<T>& value) {
    bool is_there = false;
    take(is_there);
    value.reset();
    if (is_there) take(value.emplace());
  }
  template <class T, std::size_t Size>
  void take(std::array<T, Size>& items) {
    for (T& item : items) take(item);
  }
  template <class T, std::size_t Capacity>
  void take(Bounded<T, Capacity>& items) {
    std::size_t size = 0;
    take(size);
    items.resize(size);
    for (T& item : items) take(item);
  }
  template <HasFields T>
  void take(T& value) {
    for_each_field(value, [this](std::string_view, auto& member) { take(member); });
  }
  template <class T>
  requires(!Plain<T> && !HasFields<T>) void take(T& value) { carry(*this, value); }

  std::string_view rest_;
};

}  // namespace waitpoint::run
