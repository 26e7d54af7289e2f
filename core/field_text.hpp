// SPDX-License-Identifier: BSD-3-Clause
// Values as text by their declared fields (core/fields.hpp), and the structure of those fields: for scripts.
//
// A record is NAME VALUE NAME VALUE ..., an array its elements, both nested in braces: a dictionary or a list of Tcl.
//
//   position {date 1.500000000 pose {x 1 y 2.5 heading 0}} covariance {0 0 0}
//
// Times are in seconds, durations in the unit of their field's name (_s, _ms, _us), enums are numbers. Numbers have the
// fewest digits that read back as the same value.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/fields.hpp"
#include "core/number_text.hpp"

namespace waitpoint {

/// The structure of a field, or of a whole value.
struct FieldShape {
  enum class Kind : std::uint8_t { value, record, list };

  std::string name;  ///< empty for a whole value and for elements
  Kind kind = Kind::value;
  std::vector<FieldShape> parts;  ///< the fields of a record; one for the elements of a list
};

template <class T>
std::string text_of(const T& value, std::string_view name = "");

namespace internal {

inline std::string duration_text(Duration duration, std::string_view name) {
  constexpr double ns_of_ms = 1e6, ns_of_us = 1e3;
  const auto ns = static_cast<double>(duration.ns());
  if (name.ends_with("_us")) return number_text(ns / ns_of_us);
  return name.ends_with("_ms") ? number_text(ns / ns_of_ms) : number_text(duration.seconds());
}

template <class T>
concept IsList = !HasFields<T> && requires(const T& items) {
  items.begin();
  items.size();
};

/// Values of several words, which are in braces within others.
template <class T>
inline constexpr bool is_nested = HasFields<T> || IsList<T> || std::is_same_v<T, Point> || std::is_same_v<T, Pose>;

template <class T>
void append_text(std::string& text, const T& value, std::string_view name) {
  if (!text.empty()) text.push_back(' ');
  if (!name.empty()) text.append(name).push_back(' ');
  if constexpr (is_nested<T>) text.push_back('{');
  text.append(text_of(value, name));
  if constexpr (is_nested<T>) text.push_back('}');
}

template <class Items>
std::string list_text(const Items& items) {
  std::string text;
  for (const auto& item : items) append_text(text, item, "");
  return text;
}

}  // namespace internal

/// The text of a value; `name` of the field that has it, for its unit.
template <class T>
std::string text_of(const T& value, std::string_view name) {
  if constexpr (HasFields<T>) {
    std::string text;
    for_each_field(value,
                   [&](std::string_view field, const auto& member) { internal::append_text(text, member, field); });
    return text;
  } else if constexpr (std::is_same_v<T, bool>) {
    return value ? "1" : "0";
  } else if constexpr (std::is_enum_v<T>) {
    return number_text(static_cast<std::int64_t>(value));
  } else if constexpr (std::is_arithmetic_v<T>) {
    return number_text(value);
  } else if constexpr (std::is_same_v<T, Time>) {
    return to_string(value);
  } else if constexpr (std::is_same_v<T, Duration>) {
    return internal::duration_text(value, name);
  } else if constexpr (std::is_same_v<T, Point>) {
    return "x " + number_text(value.x) + " y " + number_text(value.y);
  } else if constexpr (std::is_same_v<T, Pose>) {
    return "x " + number_text(value.x) + " y " + number_text(value.y) + " heading " + number_text(value.heading);
  } else {
    return internal::list_text(value);
  }
}

/// The structure of T.
template <class T>
FieldShape shape_of(std::string_view name = "") {
  FieldShape shape{std::string(name), FieldShape::Kind::value, {}};
  if constexpr (HasFields<T>) {
    shape.kind = FieldShape::Kind::record;
    const T value{};
    for_each_field(value, [&](std::string_view field, const auto& member) {
      shape.parts.push_back(shape_of<std::remove_cvref_t<decltype(member)>>(field));
    });
  } else if constexpr (std::is_same_v<T, Point> || std::is_same_v<T, Pose>) {
    shape.kind = FieldShape::Kind::record;
    for (const char* part : {"x", "y", "heading"})
      if (std::is_same_v<T, Pose> || part[0] != 'h') shape.parts.push_back({part, FieldShape::Kind::value, {}});
  } else if constexpr (internal::IsList<T>) {
    shape.kind = FieldShape::Kind::list;
    shape.parts.push_back(shape_of<std::remove_cvref_t<decltype(*std::declval<const T&>().begin())>>());
  }
  return shape;
}

}  // namespace waitpoint
