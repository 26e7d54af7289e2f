// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a value, found at run time by the path of a declared field: "speed_m_s", "position.pose.x", "via.0.y",
// "via.size".
//
// Booleans read as 0 or 1, enums as their integer, times and durations in seconds. Elements of arrays are numbered from
// 0; "size" is the number of elements of a bounded one.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/fields.hpp"
#include "core/number_text.hpp"

namespace waitpoint {

enum class FieldOutcome : std::uint8_t {
  number,
  absent,   ///< an element beyond the present size of a bounded array
  unknown,  ///< the type has no number at this path
};

/// One number to read, and the result of the last reading.
struct FieldReading {
  std::string path;
  FieldOutcome outcome = FieldOutcome::unknown;
  double number = 0;
};

template <class T>
FieldOutcome read_number(const T& value, std::string_view path, double& number);
template <class T, std::size_t N>
FieldOutcome read_number(const std::array<T, N>& items, std::string_view path, double& number);
template <class T, std::size_t N>
FieldOutcome read_number(const Bounded<T, N>& items, std::string_view path, double& number);

namespace internal {

/// The first name of a path, and the rest without the dot.
inline std::pair<std::string_view, std::string_view> split(std::string_view path) {
  const std::size_t dot = path.find('.');
  if (dot == std::string_view::npos) return {path, {}};
  return {path.substr(0, dot), path.substr(dot + 1)};
}

inline bool parse_index(std::string_view text, std::size_t count, std::size_t& index) {
  return parse_number(text, index) && index < count;
}

inline FieldOutcome found(double value, std::string_view path, double& number) {
  if (!path.empty()) return FieldOutcome::unknown;
  number = value;
  return FieldOutcome::number;
}

}  // namespace internal

/// Reads the number at `path` of a value into `number`, which is unchanged otherwise.
template <class T>
FieldOutcome read_number(const T& value, std::string_view path, double& number) {
  if constexpr (HasFields<T>) {
    const auto [name, rest] = internal::split(path);
    FieldOutcome outcome = FieldOutcome::unknown;
    for_each_field(value, [&, name = name, rest = rest](std::string_view field, const auto& member) {
      if (field == name) outcome = read_number(member, rest, number);
    });
    return outcome;
  } else if constexpr (std::is_same_v<T, Time> || std::is_same_v<T, Duration>) {
    return internal::found(static_cast<double>(value.ns()) / 1e9, path, number);
  } else if constexpr (std::is_same_v<T, Point> || std::is_same_v<T, Pose>) {
    if (path == "x") return internal::found(value.x, {}, number);
    if (path == "y") return internal::found(value.y, {}, number);
    if constexpr (std::is_same_v<T, Pose>)
      if (path == "heading") return internal::found(value.heading, {}, number);
    return FieldOutcome::unknown;
  } else {
    static_assert(std::is_enum_v<T> || std::is_arithmetic_v<T>);
    return internal::found(static_cast<double>(value), path, number);
  }
}

template <class T, std::size_t N>
FieldOutcome read_number(const std::array<T, N>& items, std::string_view path, double& number) {
  const auto [name, rest] = internal::split(path);
  std::size_t index = 0;
  return internal::parse_index(name, N, index) ? read_number(items[index], rest, number) : FieldOutcome::unknown;
}

template <class T, std::size_t N>
FieldOutcome read_number(const Bounded<T, N>& items, std::string_view path, double& number) {
  if (path == "size") return internal::found(static_cast<double>(items.size()), {}, number);
  const auto [name, rest] = internal::split(path);
  std::size_t index = 0;
  if (!internal::parse_index(name, N, index)) return FieldOutcome::unknown;
  if (index < items.size()) return read_number(items[index], rest, number);
  double ignored = 0;
  const bool is_known = read_number(T{}, rest, ignored) != FieldOutcome::unknown;
  return is_known ? FieldOutcome::absent : FieldOutcome::unknown;
}

}  // namespace waitpoint
