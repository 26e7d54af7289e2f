// SPDX-License-Identifier: BSD-3-Clause
// Splits a line of text into words, and quotes a word in a message.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace waitpoint::world {

inline constexpr std::string_view blanks = " \t\r";

/// Removes the first word from the line and returns it; empty at the end.
inline std::string_view take_word(std::string_view& line, std::string_view between_words = blanks) {
  line.remove_prefix(std::min(line.find_first_not_of(between_words), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(between_words));
  line.remove_prefix(word.size());
  return word;
}

/// The word in quotes, truncated if it is long: "'vertexx'".
inline std::string shown(std::string_view word) {
  constexpr std::size_t letters_max = 20;
  return "'" + std::string(word.substr(0, letters_max)) + "'";
}

}  // namespace waitpoint::world
