// SPDX-License-Identifier: BSD-3-Clause
// Values sent between robots: encoded by their declared fields, which are all that arrives of them. Numbers are encoded
// as in memory, in little-endian order; a Bounded array is preceded by the number of its elements in 4 bytes.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "core/fields.hpp"

namespace waitpoint::io {

/// A value with declared fields, or a number.
template <class T>
concept Sendable = HasFields<T> || std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <class T>
concept IsArray = requires(const T& value) {
  value.begin();
};
template <class T>
concept IsBounded = IsArray<T> && requires {
  T::capacity();
};

/// The size of the encoding.
template <class T>
std::size_t wire_bytes(const T& value) {
  if constexpr (HasFields<T>) {
    std::size_t sum = 0;
    for_each_field(value, [&](std::string_view, const auto& member) { sum += wire_bytes(member); });
    return sum;
  } else if constexpr (IsArray<T>) {
    std::size_t sum = IsBounded<T> ? 4 : 0;
    for (const auto& item : value) sum += wire_bytes(item);
    return sum;
  } else {
    return sizeof value;  // numbers, times, points and poses have no padding
  }
}

/// Writes the encoding to `at`, and moves `at` behind it.
template <class T>
void encode(const T& value, std::byte*& at) {
  if constexpr (HasFields<T>) {
    for_each_field(value, [&](std::string_view, const auto& member) { encode(member, at); });
  } else if constexpr (IsArray<T>) {
    if constexpr (IsBounded<T>) encode(static_cast<std::uint32_t>(value.size()), at);
    for (const auto& item : value) encode(item, at);
  } else {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(at, &value, sizeof value);
    at += sizeof value;
  }
}

template <class T>
std::vector<std::byte> encoded(const T& value) {
  std::vector<std::byte> bytes(wire_bytes(value));
  std::byte* at = bytes.data();
  encode(value, at);
  return bytes;
}

/// The first `size` bytes of `rest`, which loses them; fewer are a bug.
inline std::span<const std::byte> take(std::span<const std::byte>& rest, std::size_t size) {
  WAITPOINT_CHECK(rest.size() >= size, "an encoding ends too early");
  const std::span<const std::byte> taken = rest.first(size);
  rest = rest.subspan(size);
  return taken;
}

/// Sets `value` from the encoding at the beginning of `rest`, which loses it.
template <class T>
void decode(T& value, std::span<const std::byte>& rest) {
  if constexpr (HasFields<T>) {
    for_each_field(value, [&](std::string_view, auto& member) { decode(member, rest); });
  } else if constexpr (IsArray<T>) {
    if constexpr (IsBounded<T>) {
      std::uint32_t size = 0;
      decode(size, rest);
      value.resize(size);
    }
    for (auto& item : value) decode(item, rest);
  } else {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&value, take(rest, sizeof value).data(), sizeof value);
  }
}

template <class T>
void add_type(Digest& digest) {
  if constexpr (HasFields<T>) {
    digest.add(std::string_view("fields"));
    T::fields([&](std::string_view name, auto member, auto...) {
      digest.add(name);
      add_type<std::remove_cvref_t<decltype(std::declval<T&>().*member)>>(digest);
    });
    digest.add(std::string_view("end"));
  } else if constexpr (IsArray<T>) {
    if constexpr (IsBounded<T>) {
      digest.add(std::string_view("at most"));
      digest.add(static_cast<std::uint64_t>(T::capacity()));
    } else {
      digest.add(static_cast<std::uint64_t>(std::tuple_size_v<T>));
    }
    add_type<std::remove_cvref_t<decltype(*std::declval<T&>().begin())>>(digest);
  } else {
    digest.add(std::string_view(std::is_same_v<T, Time>       ? "time"
                                : std::is_same_v<T, Duration> ? "duration"
                                : std::is_same_v<T, Point>    ? "point"
                                : std::is_same_v<T, Pose>     ? "pose"
                                : std::is_same_v<T, bool>     ? "bool"
                                : std::is_enum_v<T>           ? "enum"
                                : std::is_floating_point_v<T> ? "floating point"
                                : std::is_unsigned_v<T>       ? "unsigned"
                                                              : "integer"));
    digest.add(static_cast<std::uint64_t>(sizeof(T)));
  }
}

/// A hash of the names and types of the declared fields: equal in all processes, and for types with equal encodings.
template <Sendable T>
std::uint64_t letter_type() {
  Digest digest;
  add_type<T>(digest);
  return digest.value();
}

template <Sendable T>
std::uint64_t hash_of(const T& value) {
  Digest digest;
  add_value(digest, value);
  return digest.value();
}

}  // namespace waitpoint::io
