// SPDX-License-Identifier: BSD-3-Clause
// Messages of random values, equal for equal seeds: among them empty and long lists and texts, and numbers that are
// none, infinite or denormal.
#pragma once

#include <bit>
#include <limits>
#include <random>

#include "modules/messages/message.hpp"

namespace waitpoint::messages {

class RandomMessages {
 public:
  explicit RandomMessages(std::uint64_t seed) : bits_(seed) {}

  template <class T>
  T make() {
    T value{};
    fill(value);
    return value;
  }

 private:
  std::size_t up_to(std::size_t most) { return bits_() % (most + 1); }
  std::size_t length(std::size_t usual, std::size_t most) { return up_to(60) == 0 ? up_to(most) : up_to(usual); }

  template <std::floating_point T>
  T number() {
    using Limits = std::numeric_limits<T>;
    constexpr T special[] = {0,
                             -T{0},
                             1,
                             -1,
                             Limits::quiet_NaN(),
                             Limits::infinity(),
                             -Limits::infinity(),
                             Limits::denorm_min(),
                             Limits::lowest(),
                             Limits::max()};
    if (up_to(3) == 0) return special[up_to(std::size(special) - 1)];
    const T value = static_cast<T>(static_cast<double>(static_cast<std::int64_t>(bits_())) * 1e-15);
    return value;
  }
  template <class T>
  void fill(T& value) {
    if constexpr (std::same_as<T, bool>) {
      value = up_to(1) == 1;
    } else if constexpr (std::is_floating_point_v<T>) {
      value = number<T>();
    } else if constexpr (Plain<T>) {
      value = static_cast<T>(bits_());
    } else if constexpr (std::same_as<T, std::string>) {
      value.resize(length(12, 5000));
      for (char& each : value) each = static_cast<char>('!' + up_to('~' - '!'));
    } else if constexpr (HasFields<T>) {
      for_each_field(value, [&](std::string_view, auto& member) { fill(member); });
    } else {
      if constexpr (is_list<T>) value.resize(Plain<typename T::value_type> ? length(20, 3000) : length(3, 50));
      for (auto& element : value) fill(element);
    }
  }

  std::mt19937_64 bits_;
};

}  // namespace waitpoint::messages
