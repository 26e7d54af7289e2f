// SPDX-License-Identifier: BSD-3-Clause
// A message is one declaration: a struct with its type's name and the table of its fields (core/fields.hpp), in the
// order of the wire.
//
//   struct Range {
//     static constexpr std::string_view type_name = "sensor_msgs/Range";
//     static constexpr Constant<std::uint8_t> constants[] = {{"ULTRASOUND", 0}, {"INFRARED", 1}};
//     std_msgs::Header header;
//     std::uint8_t radiation_type = 0;
//     static void fields(auto field) {
//       field("header", &Range::header);
//       field("radiation_type", &Range::radiation_type);
//     }
//   };
//
// From it come the bytes of ROS 1 and of CDR (wire.hpp), JSON (json.hpp), and the texts that describe the type: MD5
// sum, definition, JSON Schema (description.hpp). Fields are bool, integers, float, double, Byte, Stamp, Span,
// std::string, other messages, and std::vector and std::array of these. Facts about a field that a format does not
// know are ignored.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/fields.hpp"
#include "core/time.hpp"

namespace waitpoint::messages {

template <class T>
concept Message = HasFields<T> && requires {
  { T::type_name } -> std::convertible_to<std::string_view>;
};

/// A named value that belongs to a message's type.
template <class T>
struct Constant {
  std::string_view name;
  T value;
};

/// The value of a type's constant. An unknown name does not compile.
template <Message M>
consteval auto constant(std::string_view name) {
  for (const auto& each : M::constants)
    if (each.name == name) return each.value;
  throw "the message has no constant of this name";
}

/// Of a field that ROS 2 does not have.
struct Ros1Only {};
inline constexpr Ros1Only ros1_only;

/// Of a field that JSON may lack: it keeps its default.
struct Optional {};
inline constexpr Optional optional;

template <class Fact, class... Facts>
inline constexpr bool has_fact = (std::same_as<Fact, Facts> || ...);

/// ROS's `byte`, an integer of 8 bits under its old name.
enum class Byte : std::int8_t {};

/// ROS's `time`: the virtual time since the run's begin, or that of a log's clock.
struct Stamp {
  std::uint32_t sec = 0, nsec = 0;
  static void fields(auto field) {
    field("sec", &Stamp::sec);
    field("nsec", &Stamp::nsec);
  }
  friend bool operator==(const Stamp&, const Stamp&) = default;
};

/// ROS's `duration`.
struct Span {
  std::int32_t sec = 0, nsec = 0;
  static void fields(auto field) {
    field("sec", &Span::sec);
    field("nsec", &Span::nsec);
  }
  friend bool operator==(const Span&, const Span&) = default;
};

inline constexpr std::int64_t ns_per_s = 1'000'000'000;

/// A stamp holds 136 years, no time before 0.
inline Stamp stamp_of(Time time) {
  WAITPOINT_CHECK(time >= Time() && time.ns() / ns_per_s <= std::int64_t{UINT32_MAX}, "a time that no stamp holds");
  return {static_cast<std::uint32_t>(time.ns() / ns_per_s), static_cast<std::uint32_t>(time.ns() % ns_per_s)};
}
inline Time time_of(const Stamp& stamp) { return Time::from_ns(stamp.sec * ns_per_s + stamp.nsec); }

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

template <class T>
inline constexpr std::size_t array_size = 0;
template <class T, std::size_t N>
inline constexpr std::size_t array_size<std::array<T, N>> = N;

/// A value without parts, which the wire formats copy.
template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

}  // namespace waitpoint::messages
