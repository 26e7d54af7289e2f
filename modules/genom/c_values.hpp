// SPDX-License-Identifier: BSD-3-Clause
// Conversions between values of C and the values with declared fields that stand for them in the frame, member by
// member: padding, and what is behind the end of a text, never reaches an event. The frame has float as double, an
// enum as its integer, an array as std::array.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

namespace waitpoint::genom {

template <class T>
concept PlainC = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <PlainC To, PlainC From>
void from_c(To& to, const From& from) {
  to = static_cast<To>(from);
}
template <class To, class C>
requires requires(To& to, const C& c) { to.from(c); }
void from_c(To& to, const C& from) { to.from(from); }
template <class T, class C, std::size_t N>
void from_c(std::array<T, N>& to, const C (&from)[N]) {
  for (std::size_t i = 0; i < N; ++i) from_c(to[i], from[i]);
}
/// A text: up to its NUL, which is the last letter at the latest.
template <std::size_t N>
void from_c(std::array<char, N>& to, const char (&from)[N]) {
  to = {};
  std::copy(from, std::find(from, from + N - 1, '\0'), to.begin());
}

template <PlainC To, PlainC From>
void to_c(To& to, const From& from) {
  to = static_cast<To>(from);
}
template <class C, class From>
requires requires(const From& from, C& c) { from.to(c); }
void to_c(C& to, const From& from) { from.to(to); }
template <class C, class T, std::size_t N>
void to_c(C (&to)[N], const std::array<T, N>& from) {
  for (std::size_t i = 0; i < N; ++i) to_c(to[i], from[i]);
}

/// Assigns any value of C, an array too.
template <class C>
void copy_c(C& to, const C& from) {
  if constexpr (std::is_array_v<C>)
    for (std::size_t i = 0; i < std::extent_v<C>; ++i) copy_c(to[i], from[i]);
  else
    to = from;
}

}  // namespace waitpoint::genom
