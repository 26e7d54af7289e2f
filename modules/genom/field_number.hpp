// SPDX-License-Identifier: BSD-3-Clause
// One number of a value with declared fields, found by its name at run time: for conditions on posters.
//
// A name is as in Settings: "volts", "position.pose.x", "via.2.y". Durations and times are in seconds, false is 0.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

#include "core/fields.hpp"

namespace waitpoint::genom {

template <class T>
std::optional<double> field_number(const T& value, std::string_view name);

template <class Array>
std::optional<double> element_number(const Array& values, std::string_view name) {
  const std::size_t dot = name.find('.');
  const std::string_view index = name.substr(0, dot);
  std::size_t i = 0;
  const auto [end, error] = std::from_chars(index.data(), index.data() + index.size(), i);
  if (error != std::errc() || end != index.data() + index.size() || i >= values.size()) return std::nullopt;
  return field_number(values[i], dot == name.npos ? std::string_view() : name.substr(dot + 1));
}

/// Nothing if the value has no such number, or now has no such element.
template <class T>
std::optional<double> field_number(const T& value, std::string_view name) {
  if constexpr (HasFields<T>) {
    std::optional<double> number;
    for_each_field(value, [&](std::string_view field, const auto& member) {
      if (name == field)
        number = field_number(member, {});
      else if (name.size() > field.size() && name.starts_with(field) && name[field.size()] == '.')
        number = field_number(member, name.substr(field.size() + 1));
    });
    return number;
  } else if constexpr (std::is_same_v<T, Pose>) {
    if (name == "heading") return value.heading;
    return name == "x" || name == "y" ? field_number(value.position(), name) : std::nullopt;
  } else if constexpr (std::is_same_v<T, Point>) {
    if (name == "x") return value.x;
    return name == "y" ? std::optional(value.y) : std::nullopt;
  } else if constexpr (requires { value.size(); }) {
    return element_number(value, name);
  } else if constexpr (requires { value.seconds(); }) {
    return name.empty() ? std::optional(value.seconds()) : std::nullopt;
  } else {
    return name.empty() ? std::optional(static_cast<double>(value)) : std::nullopt;
  }
}

/// True if a value of the type can have that number: arrays count as if they had any number of elements.
template <class T>
bool has_field_number(std::string_view name) {
  if constexpr (HasFields<T>) {
    bool has = false;
    T::fields([&]<class Member>(std::string_view field, Member T::*, auto...) {
      if (name == field)
        has = has || has_field_number<Member>({});
      else if (name.size() > field.size() && name.starts_with(field) && name[field.size()] == '.')
        has = has || has_field_number<Member>(name.substr(field.size() + 1));
    });
    return has;
  } else if constexpr (std::is_same_v<T, Pose> || std::is_same_v<T, Point>) {
    return name == "x" || name == "y" || (std::is_same_v<T, Pose> && name == "heading");
  } else if constexpr (requires(const T& value) { value.size(); }) {
    using Element = std::remove_cvref_t<decltype(std::declval<const T&>()[0])>;
    const std::size_t dot = name.find('.');
    std::size_t index = 0;
    const std::string_view number = name.substr(0, dot);
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
    return error == std::errc() && end == number.data() + number.size() &&
           has_field_number<Element>(dot == name.npos ? std::string_view() : name.substr(dot + 1));
  } else {
    return name.empty();
  }
}

}  // namespace waitpoint::genom
