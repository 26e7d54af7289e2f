// SPDX-License-Identifier: BSD-3-Clause
// Requirements of values sent between robots: declared fields, for the digest and for their transmission time.
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>

#include "core/fields.hpp"

namespace waitpoint::io {

/// A value with declared fields, or a number.
template <class T>
concept Sendable = HasFields<T> || std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// The bytes of the declared fields, without padding; a Bounded array counts its elements and 4 bytes for their number.
template <class T>
std::size_t wire_bytes(const T& value) {
  if constexpr (HasFields<T>) {
    std::size_t sum = 0;
    for_each_field(value, [&](std::string_view, const auto& member) { sum += wire_bytes(member); });
    return sum;
  } else if constexpr (requires { value.begin(); }) {
    constexpr bool is_bounded = requires { T::capacity(); };
    std::size_t sum = is_bounded ? 4 : 0;
    for (const auto& item : value) sum += wire_bytes(item);
    return sum;
  } else {
    return sizeof value;  // numbers, times, points and poses have no padding
  }
}

template <Sendable T>
std::uint64_t hash_of(const T& value) {
  Digest digest;
  add_value(digest, value);
  return digest.value();
}

}  // namespace waitpoint::io
