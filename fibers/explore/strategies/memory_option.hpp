// SPDX-License-Identifier: BSD-3-Clause
// The memory model of the atomics of code compiled with -fsanitize=thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace waitpoint {

enum class Memory : std::uint8_t {
  sc,    ///< sequential consistency: a load returns the newest value, whatever its memory order
  weak,  ///< C++20's: a load may return older values, as the memory orders allow; see races/weak_memory.hpp
};

inline constexpr const char* memory_words = "sc or weak";

/// What exhaustive strategies leave out where loads met the bounds of weak memory, in words.
inline constexpr const char* values_left_out =
    "values of loads that are older than the last 8 or read more than 4 times";

/// Nothing for another word.
inline std::optional<Memory> memory_named(std::string_view word) {
  if (word == "sc") return Memory::sc;
  if (word == "weak") return Memory::weak;
  return std::nullopt;
}

}  // namespace waitpoint
